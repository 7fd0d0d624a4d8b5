#include <catch2/catch.hpp>

#include "analysis/order/order_map.hpp"
#include "analysis/order/order_spectrum.hpp"
#include "analysis/order/over_angle.hpp"
#include "analysis/order/sinc_interpolator.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using analysis::EvenSteps;
using analysis::over_angle;
using analysis::OverAngle;
using analysis::ShaftAngle;
using test::PeaksAt;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double rate_Hz = 5000;
constexpr Eigen::Index count = 50000;  // 10 s
constexpr double angle_rate_Hz = 1000;

// Turns after t: a run-up from 10 rev/s by 1 rev/s², or 12 rev/s with 1 % ripple at 3 Hz.
Eigen::ArrayXd run_up(const Eigen::ArrayXd& t) { return 10 * t + 0.5 * t.square(); }
Eigen::ArrayXd rippled(const Eigen::ArrayXd& t) {
  return 12 * t + 0.12 / (two_pi * 3) * (1 - (two_pi * 3 * t).cos());
}

using Turns = Eigen::ArrayXd (*)(const Eigen::ArrayXd&);

ShaftAngle angle_of(Turns turns) {
  const Eigen::Index n = 10 * 1000 + 1;
  return *ShaftAngle::of_turns(turns(test::times_s(n, angle_rate_Hz)).matrix(), 0,
                               1 / angle_rate_Hz);
}

Eigen::VectorXd line(Turns turns, double order) {
  return (two_pi * order * turns(test::times_s(count, rate_Hz)) + 0.3).cos();
}

// Largest error of a line over angle, away from the ends.
double error_of(const OverAngle& x, double order) {
  const Eigen::VectorXd ideal =
      (two_pi * order * test::times_s(x.samples.size(), x.samples_per_turn) + 0.3).cos();
  const Eigen::Index ends = 3 * x.samples_per_turn;
  return (x.samples - ideal).segment(ends, x.samples.size() - 2 * ends).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("over angle, an order is a pure sine to the bound that is stated",
          "[analysis][order][law]") {
  const auto [turns, acceleration] = GENERATE(std::pair<Turns, double>{run_up, 1.0},
                                              std::pair<Turns, double>{rippled, 0.12 * two_pi * 3});
  const auto [order, per_turn] = GENERATE(std::pair{1.0, 512}, std::pair{9.0, 512},
                                          std::pair{50.0, 512}, std::pair{50.0, 256});
  CAPTURE(acceleration, order, per_turn);
  const OverAngle x = over_angle(line(turns, order), rate_Hz, 0, angle_of(turns), {per_turn, 1});
  // Straight lines of the angle are off by δ = a·h²/8 turns, the interpolator by 2e-5.
  const double off_turns = acceleration / (8 * angle_rate_Hz * angle_rate_Hz);
  CHECK(error_of(x, order) < two_pi * order * off_turns + 2e-5);
}

TEST_CASE("constant speed leaves a signal what it was", "[analysis][order]") {
  Recording record;
  record.speed_rpm = 600;
  record.channels = {{{"a", "", "", not_known}, rate_Hz, 0, Eigen::VectorXd::Zero(count)}};
  const Eigen::VectorXd x = test::white_noise(count, 1);
  const OverAngle even = over_angle(x, rate_Hz, 0, *ShaftAngle::of(record), {500, 1});
  REQUIRE(even.samples.size() == count);  // 500 samples a turn at 10 turns/s: the same instants
  CHECK((even.samples - x).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("an order beyond what even steps hold is filtered out, not folded", "[analysis][order]") {
  // Order 100 at 128 samples a turn would show as order 28.
  const double order = GENERATE(80.0, 100.0, 127.0);
  const OverAngle x = over_angle(line(run_up, order), rate_Hz, 0, angle_of(run_up), {128, 1});
  CHECK(x.samples.segment(400, x.samples.size() - 800).cwiseAbs().maxCoeff() < 1e-4);
  // The orders that are kept are so to 0.4 of 128.
  const OverAngle kept = over_angle(line(run_up, 51), rate_Hz, 0, angle_of(run_up), {128, 1});
  CHECK(error_of(kept, 51) < 1e-4);
}

TEST_CASE("what cannot be sampled over angle is refused", "[analysis][order]") {
  const ShaftAngle angle = angle_of(run_up);
  Eigen::VectorXd x = line(run_up, 1);
  CHECK_THROWS_AS(over_angle(x, rate_Hz, 0, angle, {0, 1}), std::invalid_argument);
  CHECK_THROWS_AS(over_angle(x, rate_Hz, 0, angle, {3, 0.5}), std::invalid_argument);
  CHECK_THROWS_AS(over_angle(x, 0, 0, angle, {64, 1}), std::invalid_argument);
  CHECK(over_angle(x, rate_Hz, 0, angle, {64, 200}).samples.size() == 0);
  x[7] = not_known;
  CHECK_THROWS_AS(over_angle(x, rate_Hz, 0, angle, {64, 1}), std::invalid_argument);
  CHECK_THROWS_AS(analysis::SincInterpolator(5, 6), std::invalid_argument);
}

TEST_CASE("a geared shaft has orders of its own", "[analysis][order]") {
  // Order 39/121 of the input is order 1 of the crank in its housing.
  const ShaftAngle crank = angle_of(run_up).geared(39.0 / 121);
  CHECK(crank.mean_speed_Hz() == Approx(15.0 * 39 / 121).epsilon(1e-12));
  const auto spectrum =
      analysis::order_spectrum(over_angle(line(run_up, 39.0 / 121), rate_Hz, 0, crank, {512, 8}));
  CHECK_THAT(spectrum, PeaksAt(1));
  CHECK(spectrum.amplitude.maxCoeff() == Approx(1).epsilon(1e-3));
}

TEST_CASE("an order spectrum reads the amplitude of each order", "[analysis][order]") {
  const Eigen::VectorXd x =
      1.5 * line(rippled, 9) + 0.02 * line(rippled, 8) + Eigen::VectorXd::Constant(count, 4);
  const auto spectrum = analysis::order_spectrum(x, rate_Hz, 0, angle_of(rippled));
  const auto at = [&](double order) {
    return spectrum.amplitude[std::lround(order / spectrum.resolution)];
  };
  CHECK(at(0) == Approx(4).epsilon(1e-4));
  CHECK(at(9) == Approx(1.5).epsilon(1e-3));
  CHECK(at(8) == Approx(0.02).epsilon(1e-2));
  // Against time the ripple would give order 9 sidebands of 9·0.01·12/3/2 = 18 %, 1/4 order away.
  CHECK(at(9.25) < 2e-3);
}

TEST_CASE("an order map keeps orders upright and lets a fixed frequency cross",
          "[analysis][order]") {
  const Eigen::VectorXd x = line(run_up, 9) + test::tone(150, count, rate_Hz);
  const ShaftAngle angle = angle_of(run_up);
  const auto map = analysis::order_map(over_angle(x, rate_Hz, 0, angle, {512, 1}), angle, 10);
  REQUIRE(map.amplitude.cols() == 29);  // of 150 turns, 5 apart
  CHECK(map.resolution == Approx(0.1));
  for (Eigen::Index b = 1; b + 1 < map.amplitude.cols(); ++b) {
    CAPTURE(b);
    const double turns = 5.0 * double(b) + 5;
    const double time_s = -10 + std::sqrt(100 + 2 * turns);
    CHECK(map.time_s[b] == Approx(time_s).epsilon(1e-6));
    CHECK(map.speed_Hz[b] == Approx(10 + time_s).epsilon(1e-3));
    const auto crossing = std::lround(150 / map.speed_Hz[b] / map.resolution);
    if (std::abs(crossing - 90) < 15) continue;  // one on top of the other
    CHECK(map.amplitude(90, b) == Approx(1).epsilon(1e-2));
    CHECK(map.amplitude.col(b).segment(crossing - 10, 21).maxCoeff() > 0.2);
  }
  CHECK(analysis::order_map(OverAngle{Eigen::VectorXd::Zero(500), 512, 0}, angle, 1)
            .amplitude.cols() == 0);
  CHECK_THROWS_AS(analysis::order_map(OverAngle{x, 512, 0}, angle, 0), std::invalid_argument);
}
