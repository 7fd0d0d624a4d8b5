#include "analysis/indicators/shaft_indicators.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Indicator;

namespace {

constexpr double rate_Hz = 500;
constexpr Eigen::Index count = 5251;  // 10.5 s: 210 input turns and a bit, 10 of the output
constexpr double turns_per_s = 20;
constexpr double ratio = 21;
constexpr double arcsec_rad = std::numbers::pi / (180 * 3600);

Channel channel(const char* name, const char* unit, Eigen::VectorXd samples) {
  return {{name, unit, "", not_known}, rate_Hz, 0, std::move(samples)};
}

Eigen::VectorXd input_rad() {
  return 2 * std::numbers::pi * turns_per_s * test::times_s(count, rate_Hz);
}

// A reducer that loses a fifth, whose output runs 30 arcsec ahead and behind once per turn.
Recording lossy() {
  const Eigen::VectorXd output_turns = input_rad() / ratio;
  const Eigen::VectorXd error_rad = 30 * arcsec_rad * output_turns.array().sin();
  Recording record;
  record.source = "synthetic";
  record.channels = {
      channel("input_torque", "N·m", 2 + 0.1 * test::tone(turns_per_s, count, rate_Hz).array()),
      channel("output_torque", "N·m", Eigen::VectorXd::Constant(count, 2 * ratio * 0.8)),
      channel("input_angle", "rad", input_rad()),
      channel("output_angle", "rad", output_turns + error_rad)};
  return record;
}

double value_of(const Recording& record, std::string_view measure, std::string_view of = "") {
  analysis::Kinematics machine;
  machine.period_turns = ratio;
  const auto angle = analysis::ShaftAngle::of(record);
  REQUIRE(angle);
  for (const Indicator& i : analysis::shaft_indicators(record, *angle, machine)) {
    if (i.measure == measure && i.of == of) return i.value;
  }
  return not_known;
}

Channel& named(Recording& record, std::string_view name) {
  for (Channel& c : record.channels) {
    if (c.info.name == name) return c;
  }
  FAIL("no channel");
  return record.channels.front();
}

}  // namespace

TEST_CASE("torques and angles of a lossy reducer say what it loses", "[analysis][indicators]") {
  const Recording record = lossy();
  // 25 samples per turn meet the lowest torque to 0.8 % of the swing.
  CHECK(value_of(record, "torque_ripple", "input_torque") == Approx(0.1).epsilon(0.005));
  CHECK(value_of(record, "torque_ripple", "output_torque") == Approx(0).margin(1e-12));
  CHECK(value_of(record, "efficiency") == Approx(0.8).epsilon(1e-3));
  CHECK(value_of(record, "transmission_error") == Approx(60).epsilon(1e-3));
}

TEST_CASE("turning the other way loses as much", "[analysis][indicators]") {
  Recording record = lossy();
  for (Channel& c : record.channels) c.samples = -c.samples;
  CHECK(value_of(record, "efficiency") == Approx(0.8).epsilon(1e-3));
  CHECK(value_of(record, "transmission_error") == Approx(60).epsilon(1e-3));
}

TEST_CASE("what is not recorded, or not at the same times, makes no indicator",
          "[analysis][indicators]") {
  Recording record = lossy();
  SECTION("no output") {
    record.channels.pop_back();
    CHECK(std::isnan(value_of(record, "efficiency")));
    CHECK(std::isnan(value_of(record, "transmission_error")));
    CHECK(value_of(record, "torque_ripple", "input_torque") > 0);
  }
  SECTION("another clock") {
    named(record, "output_angle").start_s = 0.1;
    CHECK(std::isnan(value_of(record, "efficiency")));
    CHECK(std::isnan(value_of(record, "transmission_error")));
  }
  SECTION("a lost sample") {
    named(record, "output_torque").samples[100] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(value_of(record, "torque_ripple", "output_torque")));
    CHECK(std::isnan(value_of(record, "efficiency")));
    CHECK(value_of(record, "transmission_error") > 0);
  }
  SECTION("the brake's torque has the sign of a drive") {
    named(record, "output_torque").samples *= -1;
    CHECK(std::isnan(value_of(record, "efficiency")));
  }
  SECTION("less than a period") {
    for (Channel& c : record.channels) c.samples = Eigen::VectorXd(c.samples.head(400));
    CHECK(std::isnan(value_of(record, "torque_ripple", "input_torque")));
    CHECK(std::isnan(value_of(record, "transmission_error")));
  }
}
