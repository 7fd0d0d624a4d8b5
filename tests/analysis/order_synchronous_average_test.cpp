#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/order/mesh_residual.hpp"
#include "analysis/order/order_spectrum.hpp"
#include "analysis/order/over_angle.hpp"
#include "analysis/order/synchronous_average.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/recording.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::mesh_residual;
using analysis::synchronous_average;
using analysis::without_average;

namespace {

constexpr Eigen::Index period = 484;  // samples, 4 per input turn of an RV-20E
constexpr Eigen::Index periods = 50;

// A line k times per output turn.
Eigen::VectorXd line(double k, double phase_rad = 0) {
  return test::tone(k, periods * period, period, phase_rad);
}

}  // namespace

TEST_CASE("what all output turns share stays, with its amplitude and phase", "[analysis][order]") {
  const auto mean = synchronous_average(0.8 * line(120, 0.5) + line(39), period);
  CHECK(mean.periods == periods);
  CHECK((mean.average - (0.8 * line(120, 0.5) + line(39)).head(period)).cwiseAbs().maxCoeff() <
        1e-9);
  CHECK(std::abs(mean.lines[120]) == Approx(0.8));
  CHECK(std::arg(mean.lines[120]) == Approx(0.5));
  CHECK(std::abs(mean.lines[121]) < 1e-9);  // order 1 is the neighbour
  CHECK(without_average(line(39), period).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("what no turn shares is damped as a comb filter damps", "[analysis][order][law]") {
  // |sin(πPf)/(P·sin πf)| of McFadden, f cycles per period.
  const double f = GENERATE(70.01, 70.107, 70.5, 70.993);
  CAPTURE(f);
  const auto mean = synchronous_average(line(f), period);
  const double comb = std::abs(std::sin(std::numbers::pi * periods * f) /
                               (periods * std::sin(std::numbers::pi * f)));
  // The average is a stretch of a sine at f itself: no sample is above the comb's gain.
  CHECK(mean.average.cwiseAbs().maxCoeff() <= comb * (1 + 1e-9) + 1e-12);
  CHECK(mean.average.cwiseAbs().maxCoeff() >= 0.99 * comb - 1e-12);
}

TEST_CASE("the errors that are stated are those that noise makes", "[analysis][order][law]") {
  Eigen::ArrayXd made = Eigen::ArrayXd::Zero(period / 2 + 1), stated = made;
  double sample_made = 0, sample_stated = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto mean = synchronous_average(test::white_noise(periods * period, seed), period);
    made += mean.lines.array().abs2() / 20;
    stated += mean.line_error.array().square() / 20;
    sample_made += mean.average.squaredNorm() / period / 20;
    sample_stated += mean.standard_error.squaredNorm() / period / 20;
  }
  const Eigen::Index inner = period / 2 - 1;
  CHECK(made.segment(1, inner).mean() == Approx(2 * stated.segment(1, inner).mean()).epsilon(0.05));
  CHECK(sample_made == Approx(1.0 / periods).epsilon(0.05));
  CHECK(sample_stated == Approx(1.0 / periods).epsilon(0.05));
}

TEST_CASE("noise averages to lines as often as their p-value says", "[analysis][order][null]") {
  int below = 0, all = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto mean = synchronous_average(test::white_noise(8 * period, seed), period);
    for (Eigen::Index k = 0; k <= period / 2; ++k, ++all) below += mean.p_value(k) < 0.05;
  }
  CHECK(double(below) / all == Approx(0.05).margin(4 * std::sqrt(0.05 * 0.95 / all)));
}

TEST_CASE("a line in noise is there with a p-value to match", "[analysis][order]") {
  const Eigen::VectorXd x = 0.1 * line(78) + test::white_noise(periods * period, 5);
  const auto mean = synchronous_average(x, period);
  // Noise of 1 leaves √(2/(484·50)) in each part: the line is 11 of them.
  CHECK(mean.line_error[78] == Approx(std::sqrt(2.0 / (484 * 50))).epsilon(0.3));
  CHECK(std::abs(mean.lines[78]) == Approx(0.1).margin(4 * mean.line_error[78]));
  CHECK(mean.p_value(78) < 1e-12);
}

TEST_CASE("the residual keeps what is not synchronous", "[analysis][order]") {
  const Eigen::VectorXd rolling = 0.3 * line(70.34);
  const Eigen::VectorXd left = without_average(line(39) + line(120) + rolling, period);
  CHECK(test::rms(left - rolling) < 0.02 * test::rms(rolling));
}

TEST_CASE("what cannot be averaged is refused", "[analysis][order]") {
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(10);
  CHECK_THROWS_AS(synchronous_average(x, 10), std::invalid_argument);
  CHECK_THROWS_AS(synchronous_average(x, 3), std::invalid_argument);
  CHECK_THROWS_AS(synchronous_average(x, 1), std::invalid_argument);
  CHECK_THROWS_AS(synchronous_average(Eigen::VectorXd{}, 2), std::invalid_argument);
  CHECK_THROWS_AS(synchronous_average(Eigen::VectorXd::Constant(10, not_known), 5),
                  std::invalid_argument);
  CHECK_THROWS_AS(synchronous_average(x, 5).p_value(3), std::invalid_argument);
}

SCENARIO("regular meshing is taken out of an average, the odd tooth stays", "[analysis][order]") {
  GIVEN("a gear of 23 teeth with an eccentric shaft, and a dent of one tooth") {
    const Eigen::Index n = 1024;
    const auto per_turn = [&](double k) { return test::tone(k, n, double(n)); };
    const Eigen::VectorXd regular = per_turn(23) + 0.5 * per_turn(46) + 0.3 * per_turn(1) +
                                    0.2 * per_turn(22) + 0.2 * per_turn(24);
    Eigen::VectorXd dent = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < 60; ++i) {
      dent[500 + i] = 0.5 * std::exp(-double(i) / 12) * std::sin(0.9 * double(i));
    }
    WHEN("mesh, shaft and first sidebands are taken out") {
      const auto difference = mesh_residual(regular + dent, {.mesh_lines = 23, .sidebands = 1});
      THEN("a sound gear leaves nothing, a bad tooth a burst") {
        CHECK(mesh_residual(regular, {.mesh_lines = 23, .sidebands = 1}).cwiseAbs().maxCoeff() <
              1e-12);
        CHECK(analysis::kurtosis(difference) > 10);
      }
    }
    WHEN("sidebands stay") {
      const auto residual = mesh_residual(regular, {.mesh_lines = 23});
      THEN("they are what is left: rms of two tones of 0.2") {
        CHECK(test::rms(residual) == Approx(0.2));
      }
    }
    WHEN("the average is over three turns") {
      const Eigen::VectorXd three = test::tone(69, 3 * n, 3.0 * n) + test::tone(3, 3 * n, 3.0 * n) +
                                    test::tone(66, 3 * n, 3.0 * n);
      THEN("the same lines are three times as far") {
        CHECK(mesh_residual(three, {.mesh_lines = 69, .shaft_lines = 3, .sidebands = 1})
                  .cwiseAbs()
                  .maxCoeff() < 1e-12);
      }
    }
  }
  CHECK_THROWS_AS(mesh_residual(Eigen::VectorXd::Zero(10), {.mesh_lines = 6}),
                  std::invalid_argument);
}

SCENARIO("over output turns, gears and all else are parted", "[analysis][order]") {
  GIVEN("an RV-20E at 15 turns a second, 1 % up and down, with a bearing of order 4.8731") {
    constexpr double rate_Hz = 1000;
    const auto turns_at = [](const Eigen::ArrayXd& t) -> Eigen::ArrayXd {
      return 15 * t + 0.15 * 2 * (1 - (t / 2).cos());
    };
    const Eigen::ArrayXd theta = 2 * std::numbers::pi * turns_at(test::times_s(60000, rate_Hz));
    const Eigen::VectorXd x = 0.5 * theta.cos() + 0.2 * (120.0 / 121 * theta).cos() +
                              (1080.0 / 121 * theta + 1).cos() + 0.3 * (4.8731 * theta).sin() +
                              0.1 * test::white_noise(60000, 1).array();
    const auto angle =
        analysis::ShaftAngle::of_turns(turns_at(test::times_s(60001, rate_Hz)), 0, 1 / rate_Hz);
    REQUIRE(angle);
    WHEN("it is averaged over its seven whole output turns") {
      const auto over = analysis::over_angle(x, rate_Hz, 0, *angle, {64, 121});
      REQUIRE(over.samples.size() == 7 * 121 * 64);
      const auto mean = synchronous_average(over.samples, 121 * 64);
      THEN("each gear line has its own amplitude, 120/121 beside the shaft, too") {
        for (const auto& [line, amplitude] : {std::pair{121, 0.5}, {120, 0.2}, {1080, 1.0}}) {
          CHECK(std::abs(mean.lines[line]) ==
                Approx(amplitude).margin(4 * mean.line_error[line] + 1e-3));
          CHECK(mean.p_value(line) < 1e-6);
        }
      }
      THEN("the bearing is in what is left") {
        const Eigen::VectorXd left = without_average(over.samples, 121 * 64);
        const auto spectrum = analysis::order_spectrum({left, 64, 0});
        Eigen::Index peak = 0;
        spectrum.amplitude.maxCoeff(&peak);
        CHECK(spectrum.axis(peak) == Approx(4.8731).margin(spectrum.resolution));
        CHECK(spectrum.amplitude[121 * 7] < 0.01);
        CHECK(spectrum.amplitude[1080 * 7] < 0.01);
      }
    }
  }
}
