#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/order/inverter_speed.hpp"
#include "analysis/order/natural_spline.hpp"
#include "analysis/order/tachometer.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::read_tachometer;
using analysis::TachometerFault;
using Catch::Matchers::Contains;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double speed_Hz = 20;
constexpr double ripple_Hz = 3;
constexpr double ripple = 0.02;  // of the speed

double turns_at(double t) {
  return speed_Hz * t + speed_Hz * ripple / (two_pi * ripple_Hz) * std::sin(two_pi * ripple_Hz * t);
}

// When the shaft stands at so many turns: Newton's method.
double time_at(double turns) {
  double t = turns / speed_Hz;
  for (int i = 0; i < 50; ++i) {
    t -= (turns_at(t) - turns) / (speed_Hz * (1 + ripple * std::cos(two_pi * ripple_Hz * t)));
  }
  return t;
}

std::vector<double> pulses(int per_turn, int turns = 100) {
  std::vector<double> times_s;
  for (int i = 0; i <= turns * per_turn; ++i) times_s.push_back(time_at(double(i) / per_turn));
  return times_s;
}

double worst_error_turns(const analysis::ShaftAngle& angle) {
  double worst = 0;
  for (double t = 1; t < 4; t += 0.00137) {
    worst = std::max(worst, std::abs(angle.turns_at(t) - turns_at(t)));
  }
  return worst;
}

// Of the spline and of the straight lines through it, as stated.
double bound_turns(int per_turn) {
  const double w = two_pi * ripple_Hz, h = 1 / (speed_Hz * (1 - ripple) * per_turn);
  const double acceleration = speed_Hz * ripple * w;
  return 5.0 / 384 * std::pow(h, 4) * acceleration * w * w * (1 + 40 * ripple) +
         acceleration * h * h / 2048;
}

}  // namespace

TEST_CASE("pulses give the angle between them to the bound that is stated",
          "[analysis][order][law]") {
  const int per_turn = GENERATE(1, 4, 60);
  const auto reading = read_tachometer(pulses(per_turn), per_turn);
  REQUIRE(reading.angle);
  CHECK(reading.faults.empty());
  CHECK(worst_error_turns(*reading.angle) < bound_turns(per_turn) + 1e-12);
}

TEST_CASE("missing pulses are counted in, and marked", "[analysis][order]") {
  auto times_s = pulses(4);
  times_s.erase(times_s.begin() + 200, times_s.begin() + 202);
  times_s.erase(times_s.begin() + 100);
  const auto reading = read_tachometer(times_s, 4);
  REQUIRE(reading.angle);
  REQUIRE(reading.faults.size() == 2);
  CHECK(reading.faults[0].kind == TachometerFault::Kind::missing);
  CHECK(reading.faults[0].time_s == Approx(time_at(99 / 4.0)));
  CHECK(reading.faults[0].pulses == 1);
  CHECK(reading.faults[1].pulses == 2);
  CHECK(worst_error_turns(*reading.angle) < 81 * bound_turns(4));  // (3h)⁴ in the wider gap
}

TEST_CASE("extra pulses are left out, and marked, wherever they fall", "[analysis][order]") {
  auto times_s = pulses(4);
  const double share = GENERATE(0.05, 0.3, 0.5, 0.7, 0.95);
  CAPTURE(share);
  const double extra_s = times_s[150] + share * (times_s[151] - times_s[150]);
  times_s.insert(times_s.begin() + 151, extra_s);
  const auto reading = read_tachometer(times_s, 4);
  REQUIRE(reading.angle);
  REQUIRE(reading.faults.size() == 1);
  CHECK(reading.faults[0].kind == TachometerFault::Kind::extra);
  CHECK(reading.faults[0].time_s == extra_s);
  CHECK(worst_error_turns(*reading.angle) < bound_turns(4));
}

TEST_CASE("a tachometer that cannot be trusted gives no angle, and says why",
          "[analysis][order][null]") {
  const auto why = [](std::vector<double> times_s) {
    const auto reading = read_tachometer(times_s, 1);
    CHECK_FALSE(reading.angle);
    return reading.why_not;
  };
  CHECK_THAT(why({1, 2, 3}), Contains("3 pulses"));
  auto times_s = pulses(1);
  std::swap(times_s[50], times_s[51]);
  CHECK_THAT(why(times_s), Contains("do not rise"));
  times_s = pulses(1);
  for (std::size_t i = 60; i < times_s.size(); ++i) times_s[i] += 0.5 / speed_Hz + 0.9 / speed_Hz;
  CHECK_THAT(why(times_s), Contains("no whole number"));
  times_s.clear();
  for (int i = 0; i < 100; ++i) {
    if (i % 8 != 0) times_s.push_back(0.05 * i);
  }
  CHECK_THAT(why(times_s), Contains("missing or extra"));
  CHECK_THROWS_AS(read_tachometer({1, 2, not_known}, 1), std::invalid_argument);
  CHECK_THROWS_AS(read_tachometer(pulses(1), 0), std::invalid_argument);
}

TEST_CASE("the speed of an inverter gives the angle by its integral", "[analysis][order]") {
  const double rate_Hz = 50;
  const Eigen::ArrayXd t = test::times_s(251, rate_Hz);
  Channel speed{{"speed", "rad/s", "", not_known}, rate_Hz, 0, {}};
  speed.samples = two_pi * speed_Hz * (1 + ripple * (two_pi * ripple_Hz * t).cos());
  // At both ends the spline is straight where the speed bends: an angle within h³·max|s″|/8.
  const double w = two_pi * ripple_Hz, h = 1 / rate_Hz;
  const double end_turns = speed_Hz * ripple * w * w * h * h * h / 8;
  const double inside_turns =
      speed_Hz * ripple / w * 5 / 384 * std::pow(w * h, 4) + speed_Hz * ripple * w * h * h / 512;
  SECTION("of all samples") {
    const auto angle = analysis::angle_of_speed(speed);
    REQUIRE(angle);
    CHECK(worst_error_turns(*angle) < inside_turns + end_turns);
  }
  SECTION("though some were lost") {
    speed.samples[120] = not_known;
    const auto angle = analysis::angle_of_speed(speed);
    REQUIRE(angle);
    CHECK(worst_error_turns(*angle) < 16 * inside_turns + end_turns);
  }
  SECTION("not of a shaft that stands or turns back") {
    speed.samples.setZero();
    CHECK_FALSE(analysis::angle_of_speed(speed));
    speed.samples = Eigen::ArrayXd::LinSpaced(251, -5, 5).matrix();
    CHECK_FALSE(analysis::angle_of_speed(speed));
  }
}

TEST_CASE("a natural spline goes through its points and integrates exactly",
          "[analysis][order][law]") {
  Eigen::VectorXd at(5), values(5);
  at << 0, 1, 1.5, 4, 5;
  values << 1, -2, 0, 3, 3;
  const analysis::NaturalSpline curve(at, values);
  for (Eigen::Index i = 0; i < 5; ++i) CHECK(curve(at[i]) == Approx(values[i]).margin(1e-12));
  double sum = 0;  // Simpson's rule is exact for a cubic
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double h = at[i + 1] - at[i];
    sum += h / 6 * (values[i] + 4 * curve(at[i] + h / 2) + values[i + 1]);
  }
  CHECK(curve.integral(5) == Approx(sum).epsilon(1e-12));
  CHECK(curve.integral(0) == 0);
  // A straight line stays one, beyond its ends, too.
  const analysis::NaturalSpline straight(at, 2 * at);
  CHECK(straight(7) == Approx(14));
  CHECK(straight(-1) == Approx(-2));
  CHECK(straight.integral(7) == Approx(49));
  CHECK_THROWS_AS(analysis::NaturalSpline(-at, values), std::invalid_argument);
}
