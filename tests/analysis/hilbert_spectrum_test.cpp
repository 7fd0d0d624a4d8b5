#include "analysis/emd/hilbert_spectrum.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "analysis/emd/emd.hpp"
#include "analysis/hilbert.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::instantaneous_frequency_Hz;
using analysis::marginal_spectrum;

namespace {

constexpr double rate_Hz = 1000;
constexpr Eigen::Index n = 2000;

}  // namespace

TEST_CASE("a tone has its frequency at every instant", "[analysis][hilbert][law]") {
  for (const double tone_Hz : {0.5, 100., 499.5}) {
    const Eigen::VectorXd found =
        instantaneous_frequency_Hz(3 * test::tone(tone_Hz, n, rate_Hz, 0.7), rate_Hz);
    CHECK((found.array() - tone_Hz).abs().maxCoeff() < 1e-8);
  }
}

TEST_CASE("a swing whose frequency changes has that of each instant", "[analysis][hilbert][law]") {
  // 100 Hz give or take 10, twice a second: phase 2π·(100 t + 5 / 2π · sin(2π·2 t)).
  const Eigen::ArrayXd t = test::times_s(n, rate_Hz);
  const Eigen::ArrayXd swing_rad = 2 * M_PI * 2 * t;
  const Eigen::VectorXd x = (2 * M_PI * 100 * t + 5 * swing_rad.sin()).cos();
  const Eigen::VectorXd expected_Hz = 100 + 10 * swing_rad.cos();
  // The mean of two steps sees the curve of the swing, (2π·2 / 1000)² / 6 of it; the ends have one.
  const Eigen::VectorXd error_Hz = instantaneous_frequency_Hz(x, rate_Hz) - expected_Hz;
  CHECK(error_Hz.segment(1, n - 2).cwiseAbs().maxCoeff() < 3e-4);
}

TEST_CASE("one transform tells what two do, to the bit", "[analysis][hilbert]") {
  const Eigen::VectorXd x = test::white_noise(n, 3);
  const auto signal = analysis::analytic_signal(x, rate_Hz);
  CHECK(signal.envelope == analysis::envelope(x));
  CHECK(signal.frequency_Hz == instantaneous_frequency_Hz(x, rate_Hz));
  CHECK_THROWS_WITH(analysis::analytic_signal(x.head(3), rate_Hz), Catch::Contains("at least 4"));
  CHECK_THROWS_AS(analysis::analytic_signal(x, 0), std::invalid_argument);
}

TEST_CASE("the marginal spectrum holds each tone's power in its bin", "[analysis][hilbert][law]") {
  Eigen::MatrixXd imfs(n, 2);
  imfs.col(0) = 2 * test::tone(205, n, rate_Hz, 0.2);
  imfs.col(1) = test::tone(35, n, rate_Hz, 1);
  imfs.col(1).tail(n / 2).setZero();  // comes and goes
  const auto spectrum = marginal_spectrum(imfs, rate_Hz, 50);
  CHECK(spectrum.resolution_Hz == Approx(10));
  CHECK(spectrum.power[20] == Approx(2).epsilon(1e-12));
  CHECK(spectrum.power[3] == Approx(0.25).epsilon(0.05));
  CHECK(spectrum.power.sum() + spectrum.unplaced == Approx(2.25).epsilon(0.01));
}

TEST_CASE("no power is lost: of noise, too, all of it is in a bin or told", "[analysis][hilbert]") {
  const Eigen::MatrixXd imfs = analysis::emd(test::white_noise(n, 4)).imfs;
  const auto spectrum = marginal_spectrum(imfs, rate_Hz, 20);
  // The mean of half the squared envelope is the mean square, but for the mean and the last line.
  CHECK(spectrum.power.sum() + spectrum.unplaced ==
        Approx(imfs.squaredNorm() / double(n)).epsilon(0.02));
  CHECK(spectrum.unplaced < 0.05 * spectrum.power.sum());
}

TEST_CASE("instantaneous frequencies refuse what they cannot answer",
          "[analysis][hilbert][errors]") {
  CHECK_THROWS_AS(instantaneous_frequency_Hz(test::white_noise(3, 1), rate_Hz),
                  std::invalid_argument);
  CHECK_THROWS_AS(instantaneous_frequency_Hz(test::white_noise(30, 1), 0), std::invalid_argument);
  CHECK_THROWS_AS(marginal_spectrum(test::white_noise(30, 1), rate_Hz, 0), std::invalid_argument);
}
