#include "sequences/settling.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

using namespace rvbench;
using sequences::Settling;
using sequences::SettlingRule;

namespace {

// When a motion settles: speed and torque as functions of time, at 10 ms ticks; NaN if never.
double settled_s(const SettlingRule& rule, double planned_rpm,
                 const std::function<double(double)>& speed_rpm,
                 const std::function<double(double)>& torque_Nm) {
  Settling settling(rule, planned_rpm);
  double angle_rad = 0;
  for (int tick = 0; tick <= 3000; ++tick) {
    const double t_s = tick * 0.01;
    settling.add(t_s, angle_rad, torque_Nm(t_s));
    if (settling.settled()) return t_s;
    angle_rad += units::rad_s_from_rpm(speed_rpm(t_s + 0.005)) * 0.01;
  }
  return not_known;
}

double steady_torque(double) { return 1.0; }

}  // namespace

TEST_CASE("a steady shaft settles after the time to hold, and not before",
          "[sequences][settling]") {
  CHECK(settled_s(
            {.hold_s = 2}, 1000, [](double) { return 1000.0; }, steady_torque) == Approx(2));
  CHECK(settled_s(
            {.hold_s = 5}, 1000, [](double) { return 1000.0; }, steady_torque) == Approx(5));
}

TEST_CASE("a ramp settles when all of the hold is flat", "[sequences][settling]") {
  // 500 rpm/s up to 1000 rpm: flat from 2 s on, so that 2 s of hold end at 4 s.
  const auto ramp = [](double t_s) { return std::min(1000.0, 500 * t_s); };
  CHECK(settled_s({.hold_s = 2}, 1000, ramp, steady_torque) == Approx(4));
  // A ramp too slow to see in one window is still seen across the hold: 20 rpm/s make 30 rpm
  // between the middles of the first and the last window, against a band of +-10.
  const auto slow = [](double t_s) { return std::min(1000.0, 700 + 20 * t_s); };
  CHECK(settled_s({.hold_s = 2}, 1000, slow, steady_torque) > 15);
}

TEST_CASE("slip within the tolerance settles, beyond it never", "[sequences][settling]") {
  const SettlingRule rule{.speed_tolerance_pct = 6};
  CHECK(settled_s(
            rule, 1000, [](double) { return 945.0; }, steady_torque) == Approx(2));
  CHECK(std::isnan(settled_s(
      rule, 1000, [](double) { return 935.0; }, steady_torque)));
}

TEST_CASE("torque must hold still too, but for its absolute band", "[sequences][settling]") {
  const auto steady = [](double) { return 1000.0; };
  const SettlingRule rule{.torque_band_pct = 10, .torque_band_Nm = 0.1};
  const auto swinging = [](double amplitude_Nm, double mean_Nm) {
    return [=](double t_s) { return mean_Nm + (std::fmod(t_s, 2) < 1 ? 1 : -1) * amplitude_Nm; };
  };
  CHECK(settled_s(rule, 1000, steady, swinging(0.15, 1)) == Approx(2));  // band: 0.1 + 0.1
  CHECK(std::isnan(settled_s(rule, 1000, steady, swinging(0.25, 1))));
  CHECK(settled_s(rule, 1000, steady, swinging(0.05, 0)) == Approx(2));  // no load: 0.1 alone
  CHECK(std::isnan(settled_s(rule, 1000, steady, swinging(0.15, 0))));
}

TEST_CASE("samples that are not known settle nothing", "[sequences][settling]") {
  Settling settling({}, 1000);
  for (int tick = 0; tick < 1000; ++tick) settling.add(tick * 0.01, not_known, 1);
  CHECK_FALSE(settling.settled());
  CHECK(std::isnan(settling.mean_speed_rpm()));
}

TEST_CASE("a tick without a fresh value counts for nothing", "[sequences][settling]") {
  // News come every 40 ms, 1 N·m and 3 N·m in turn; the bench ticks every 10 ms and finds the 3 N·m
  // three times over. The mean of what was measured is 2 N·m.
  Settling settling({.torque_band_pct = 100, .hold_s = 2}, 1000);
  const double rad_s = units::rad_s_from_rpm(1000);
  for (int news = 0; news <= 100; ++news) {
    const double t_s = news * 0.04;
    const bool high = news % 2 == 1;
    for (int tick = 0; tick < (high ? 3 : 1); ++tick) settling.add(t_s, rad_s * t_s, high ? 3 : 1);
  }
  CHECK(settling.mean_torque_Nm() == Approx(2));
  CHECK(settling.mean_speed_rpm() == Approx(1000));
}
