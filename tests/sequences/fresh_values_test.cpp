#include "sequences/fresh_values.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "sequences/angle_track.hpp"
#include "sequences/lateness.hpp"

using namespace rvbench;
using sequences::FreshValues;

namespace {

FreshValues round_of(double t0_s, int scans, int samples) {
  FreshValues round;
  round.acceleration_rate_Hz = round.torque_rate_Hz = 1000;
  round.accelerations.emplace();
  round.accelerations->t0_s = t0_s;
  round.accelerations->scans.resize(scans, 2);
  round.accelerations->scans.setConstant(float(t0_s));
  round.accelerations->lost = 1;
  round.torque.emplace();
  round.torque->t0_s = t0_s;
  round.torque->samples.assign(std::size_t(samples), {t0_s, 0});
  return round;
}

}  // namespace

TEST_CASE("rounds merge into one: streams are joined, of the rest the newest counts",
          "[sequences]") {
  std::vector<FreshValues> rounds{round_of(1, 3, 1), {}, round_of(2, 2, 4)};
  rounds[0].speed_rpm = 600;
  rounds[0].safety = hal::SafetyStatus{true, false, 25};
  rounds[1].brake = hal::BrakeStatus{70, false};
  rounds[2].safety = hal::SafetyStatus{false, false, 26};
  const FreshValues all = sequences::merged(rounds);
  REQUIRE(all.accelerations->scans.rows() == 5);
  CHECK(all.accelerations->t0_s == 1);
  CHECK(all.accelerations->scans(2, 1) == 1);
  CHECK(all.accelerations->scans(3, 0) == 2);
  CHECK(all.accelerations->lost == 2);
  REQUIRE(all.torque->samples.size() == 5);
  CHECK(all.torque->samples[1].torque_Nm == 2);
  CHECK(all.safety->housing_temp_degC == 26);
  CHECK(all.brake->torque_Nm == 70);
  CHECK(all.speed_rpm == 600);
  CHECK_FALSE(all.drive);
  const FreshValues nothing = sequences::merged({});
  CHECK_FALSE(nothing.torque);
  CHECK_FALSE(nothing.accelerations);
}

TEST_CASE("speed is told over the shortest stretch that is long enough", "[sequences]") {
  sequences::AngleTrack track;
  CHECK(std::isnan(track.speed_rpm(0.01)));
  for (int i = 0; i <= 20; ++i) track.add(0.01 * i, i < 10 ? 0 : (i - 10) * 0.1);
  CHECK(track.speed_rpm(0.01) == Approx(10 * 60 / (2 * M_PI)));
  CHECK(track.speed_rpm(0.1) == Approx(10 * 60 / (2 * M_PI)));
  CHECK(track.speed_rpm(0.2) == Approx(5 * 60 / (2 * M_PI)));
  CHECK(std::isnan(track.speed_rpm(0.21)));
}

TEST_CASE("lateness: quantiles to 9 %, the longest exactly", "[sequences]") {
  sequences::Lateness late;
  CHECK(std::isnan(late.quantile_s(0.5)));
  for (int i = 1; i <= 1000; ++i) late.add(1e-5 * i);
  CHECK(late.rounds() == 1000);
  CHECK(late.longest_s() == 0.01);
  for (const double share : {0.01, 0.5, 0.99}) {
    CAPTURE(share);
    CHECK(late.quantile_s(share) >= 0.01 * share);
    CHECK(late.quantile_s(share) <= 0.01 * share * 1.1);
  }
  CHECK(late.quantile_s(1) == 0.01);
  sequences::Lateness punctual;
  punctual.add(-1e-9);
  CHECK(punctual.quantile_s(1) <= 1e-6);
}
