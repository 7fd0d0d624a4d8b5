#include "analysis/envelope/whitening.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/envelope/squared_envelope_spectrum.hpp"
#include "analysis/fft.hpp"
#include "analysis/spectrum.hpp"
#include "tests/analysis/envelope/strikes.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::white_noise;

namespace {

constexpr double rate_Hz = 8000;

Eigen::VectorXd real_cepstrum(const Eigen::VectorXd& x) {
  Eigen::VectorXcd log = fft(x).cwiseAbs().array().max(1e-12).log().cast<std::complex<double>>();
  log[0] = 0;  // the mean has no place in it, nor has half the rate
  log[log.size() - 1] = 0;
  return inverse_fft(log, x.size());
}

}  // namespace

TEST_CASE("pre-whitening leaves every line its phase, and one amplitude to all",
          "[analysis][envelope]") {
  const Eigen::VectorXd x = test::reddened(white_noise(1000, 1), 0.9);
  const Eigen::VectorXd white = cepstrum_prewhitened(x);
  const Eigen::VectorXcd before = fft(x), after = fft(white);
  for (Eigen::Index k = 1; k < 500; ++k) {
    CHECK(std::abs(after[k]) == Approx(std::sqrt(1000)));
    CHECK(std::abs(std::arg(after[k] / before[k])) < 1e-9);
  }
  CHECK(test::rms(white) == Approx(1).epsilon(2e-3));
  // No cepstrum is left but at quefrency 0, which is the level, and what two lines without twin
  // give.
  const Eigen::VectorXd cepstrum = real_cepstrum(white);
  CHECK(cepstrum.tail(999).cwiseAbs().maxCoeff() < 2 * std::log(std::sqrt(1000)) / 1000 + 1e-9);
}

SCENARIO("strikes are heard when tones are taken out", "[analysis][envelope]") {
  GIVEN("strikes at 37 Hz, under meshes 30 dB above them that swing at 10 Hz") {
    constexpr Eigen::Index n = 32000;
    const Eigen::VectorXd strikes = test::Strikes{rate_Hz, 37, 2500, 600, 0.005}.samples(n);
    const Eigen::VectorXd mesh =
        test::ringing({.carrier_Hz = 2200, .rate_Hz = 10, .depth = 0.5}, n, rate_Hz) +
        test::ringing({.carrier_Hz = 2750, .rate_Hz = 10, .depth = 0.5}, n, rate_Hz);
    const double loud = std::pow(10, 30.0 / 20) * test::rms(strikes) / test::rms(mesh);
    const Eigen::VectorXd x = strikes + loud * mesh + 0.3 * test::rms(strikes) * white_noise(n, 1);
    WHEN("the squared envelope is taken as it is") {
      const TestedSpectrum tested = squared_envelope_spectrum(x, rate_Hz, 0, 4000);
      THEN("it swings at 10 Hz, and not at 37") {
        CHECK(evidence_near(tested, 10, 0.5, 1e-3).p_value < 1e-6);
        CHECK(evidence_near(tested, 37, 0.5, 1e-3).p_value > 1e-3);
      }
    }
    WHEN("x is pre-whitened") {
      const TestedSpectrum tested =
          squared_envelope_spectrum(cepstrum_prewhitened(x), rate_Hz, 0, 4000);
      THEN("it swings at 37 Hz, and not at 10") {
        CHECK(evidence_near(tested, 37, 0.5, 1e-3).p_value < 1e-6);
        CHECK(evidence_near(tested, 10, 0.5, 1e-3).p_value > 1e-3);
      }
    }
  }
}

TEST_CASE("over its floor noise is white and tones stay as high above it", "[analysis][envelope]") {
  constexpr Eigen::Index n = 40000;
  const Eigen::VectorXd noise = test::reddened(white_noise(n, 1), 0.9);
  const Eigen::VectorXd tone = test::tone(2000, n, rate_Hz);
  // At a quarter of the rate noise of that memory has a density of 1/|1 + 0.9i|² of the white
  // one's.
  const double gain = std::sqrt(1 + 0.81);
  const Eigen::VectorXd white = floor_whitened(noise + tone);
  const Spectrum spectrum = amplitude_spectrum(white, rate_Hz, Window::rectangular);
  // The floor is a median of 320 Hann lines, worth 102: 4 standard deviations are 20 %.
  CHECK(spectrum.amplitude[10000] == Approx(gain).epsilon(0.2));
  for (const Eigen::Index from : {200, 2000, 12000, 18000}) {
    CAPTURE(from);
    // 2000 lines of 4/N each, of which 4 standard deviations are 9 %
    CHECK(spectrum.amplitude.segment(from, 2000).squaredNorm() ==
          Approx(2000 * 4.0 / n).epsilon(0.09));
  }
}

TEST_CASE("silence stays silent, and what is no signal throws", "[analysis][envelope]") {
  CHECK(cepstrum_prewhitened(Eigen::VectorXd::Zero(64)).isZero());
  CHECK(floor_whitened(Eigen::VectorXd::Zero(64)).isZero());
  Eigen::VectorXd gap = white_noise(64, 1);
  gap[3] = std::nan("");
  CHECK_THROWS_AS(cepstrum_prewhitened(gap), std::invalid_argument);
  CHECK_THROWS_AS(floor_whitened(gap), std::invalid_argument);
  CHECK_THROWS_AS(cepstrum_prewhitened(white_noise(3, 1)), std::invalid_argument);
}
