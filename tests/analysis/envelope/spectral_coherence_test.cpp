#include "analysis/envelope/spectral_coherence.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/envelope/band_pass.hpp"
#include "analysis/envelope/whitening.hpp"
#include "tests/analysis/envelope/strikes.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::UniformBelow;
using test::white_noise;

namespace {

constexpr double rate_Hz = 8000;

// X[k] of a Hann window, by its definition.
std::complex<double> line_of(const Eigen::VectorXd& x, Eigen::Index k) {
  const double turn_rad = 2 * std::numbers::pi / double(x.size());
  const double mean = x.mean();
  std::complex<double> sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double hann = 1 - std::cos(turn_rad * (double(i) + 0.5));
    sum += hann * (x[i] - mean) * std::polar(1.0, -turn_rad * double(k) * double(i));
  }
  return sum;
}

// Noise whose amplitude swings by `depth` at `frequency_Hz`.
Eigen::VectorXd swinging(Eigen::Index n, double depth, double frequency_Hz, unsigned seed) {
  return (1 + depth * test::tone(frequency_Hz, n, rate_Hz).array()) * white_noise(n, seed).array();
}

double least_p(const TestedSpectrum& tested) {
  double least = 1;
  for (Eigen::Index line = tested.first; line <= tested.last; ++line) {
    least = std::min(least, tested.p_value(line));
  }
  return std::min(1.0, least * double(tested.last - tested.first + 1));
}

}  // namespace

TEST_CASE("the coherence is that of its definition, line by line", "[analysis][envelope]") {
  const Eigen::VectorXd x = swinging(400, 0.5, 100, 1);
  const SpectralCoherence c = spectral_coherence(x, rate_Hz, {.highest = 800, .bands = 5});
  REQUIRE(c.squared.rows() == 5);
  REQUIRE(c.squared.cols() == 41);
  CHECK(c.resolution == 20);
  const auto size = static_cast<Eigen::Index>(std::lround(c.width / c.resolution));
  for (const Eigen::Index band : {0, 2, 4}) {
    for (const Eigen::Index a : {0, 1, 5, 40}) {
      CAPTURE(band, a);
      std::complex<double> product = 0;
      double below = 0, above = 0;
      for (Eigen::Index k = 1 + band * size; k < 1 + (band + 1) * size; ++k) {
        product += line_of(x, k + a) * std::conj(line_of(x, k));
        below += std::norm(line_of(x, k));
        above += std::norm(line_of(x, k + a));
      }
      CHECK(c.squared(band, a) == Approx(std::norm(product) / (below * above)).epsilon(1e-9));
    }
  }
}

TEST_CASE(
    "noise that swings by m is coherent by m/(1 + m²/2), and by a quarter of m² at twice that",
    "[analysis][envelope][law]") {
  // The Fourier coefficients of (1 + m·cos)² over its mean.
  constexpr double m = 0.6, mean = 1 + m * m / 2;
  const SpectralCoherence c =
      spectral_coherence(swinging(160000, m, 50, 1), rate_Hz, {.highest = 120, .bands = 10});
  const TestedSpectrum enhanced = enhanced_envelope_spectrum(c);
  CHECK(enhanced.spectrum.axis(1000) == Approx(50));
  CHECK_THAT(enhanced.spectrum, test::PeaksAt(50));
  CHECK(enhanced.spectrum.amplitude[1000] == Approx(m / mean).epsilon(0.02));
  CHECK(enhanced.spectrum.amplitude[2000] == Approx(m * m / 4 / mean).epsilon(0.15));
  CHECK(enhanced.p_value(1000) < 1e-30);
}

TEST_CASE("white noise is coherent as often as stated", "[analysis][envelope][null]") {
  NullDraws of_a_band, of_a_line, of_all;
  double mean = 0;
  constexpr unsigned draws = 150;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const SpectralCoherence c =
        spectral_coherence(white_noise(8000, seed), rate_Hz, {.highest = 500, .bands = 16});
    mean += c.squared.rightCols(c.squared.cols() - 3).mean() * c.lines / draws;
    for (const Eigen::Index a : {10, 77, 200, 333}) {
      for (const Eigen::Index band : {0, 7, 15}) {
        of_a_band.p_values.push_back(std::pow(1 - c.squared(band, a), c.lines - 1));
      }
      of_a_line.p_values.push_back(enhanced_envelope_spectrum(c).p_value(a));
    }
    of_all.p_values.push_back(least_p(enhanced_envelope_spectrum(c)));
  }
  CHECK(mean == Approx(1).epsilon(0.02));  // of 112 lines, to first order in one over them
  CHECK_THAT(of_a_band, UniformBelow({0.01, 0.1, 0.5, 0.9}));
  CHECK_THAT(of_a_line, NoOftenerThanStated({0.01, 0.1, 0.5}));
  CHECK(of_a_line.share_below(0.1) > 0.03);  // nor is it never
  CHECK_THAT(of_all, NoOftenerThanStated({0.01, 0.1}));
}

TEST_CASE("coloured noise is not coherent either, once it is whitened",
          "[analysis][envelope][null]") {
  NullDraws draws;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Eigen::VectorXd x = test::resonant(white_noise(8000, seed), 0.2, 0.02);
    draws.p_values.push_back(least_p(enhanced_envelope_spectrum(
        spectral_coherence(floor_whitened(x), rate_Hz, {.highest = 500, .bands = 16}))));
  }
  CHECK_THAT(draws, NoOftenerThanStated({0.01, 0.1}));
}

SCENARIO("a band that swings is found, and where it is", "[analysis][envelope]") {
  GIVEN("noise of which 2 to 3 kHz swing at 30 Hz, under four times as much that does not") {
    constexpr Eigen::Index n = 80000;
    const Eigen::VectorXd x =
        band_passed(swinging(n, 1, 30, 1), rate_Hz, 2000, 3000) + 0.5 * white_noise(n, 2);
    const SpectralCoherence c = spectral_coherence(x, rate_Hz, {.highest = 100, .bands = 16});
    WHEN("all bands are averaged") {
      const TestedSpectrum enhanced = enhanced_envelope_spectrum(c);
      THEN("30 Hz stands out of the whole spectrum, and so may 60, but nothing else") {
        CHECK(enhanced.p_value(300) < enhanced.rate_of_one_line(1e-6));
        for (const Eigen::Index line : enhanced.significant(1e-3)) {
          CHECK(std::abs(line - 300 * std::lround(double(line) / 300)) <= 2);  // as wide as Hann's
        }
      }
    }
    WHEN("only those within it are") {
      const TestedSpectrum improved = improved_envelope_spectrum(c, 2000, 3000);
      THEN("it stands out further") {
        CHECK(improved.spectrum.amplitude[300] >
              1.5 * enhanced_envelope_spectrum(c).spectrum.amplitude[300]);
      }
    }
    WHEN("only those outside are") {
      THEN("nothing does") {
        CHECK(improved_envelope_spectrum(c, 0, 1800).significant(1e-3).empty());
      }
    }
    WHEN("there is no such band") {
      THEN("it throws") {
        CHECK_THROWS_AS(improved_envelope_spectrum(c, 5000, 6000), std::invalid_argument);
      }
    }
  }
}

TEST_CASE("bursts without a period are not coherent at any one frequency",
          "[analysis][envelope][null]") {
  NullDraws draws;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Eigen::VectorXd x = test::Strikes{rate_Hz, 30, 2000, 500, 0.5}.samples(16000, seed) +
                              0.05 * white_noise(16000, seed);
    const TestedSpectrum enhanced = enhanced_envelope_spectrum(
        spectral_coherence(floor_whitened(x), rate_Hz, {.highest = 400, .bands = 16}));
    draws.p_values.push_back(evidence_near(enhanced, 171, 2, 0.1).p_value);
  }
  CHECK_THAT(draws, NoOftenerThanStated({0.01, 0.1}));
}

TEST_CASE("nothing to be coherent throws", "[analysis][envelope]") {
  const Eigen::VectorXd x = white_noise(1000, 1);
  CHECK_THROWS_AS(spectral_coherence(x, rate_Hz, {}), std::invalid_argument);
  CHECK_THROWS_AS(spectral_coherence(x, rate_Hz, {.highest = 4000}), std::invalid_argument);
  CHECK_THROWS_AS(spectral_coherence(x, rate_Hz, {.highest = 100}), std::invalid_argument);
  CHECK_THROWS_AS(spectral_coherence(x, rate_Hz, {.highest = 100, .bands = 0}),
                  std::invalid_argument);
  CHECK_THROWS_AS(spectral_coherence(x, 0, {.highest = 100, .bands = 4}), std::invalid_argument);
  const SpectralCoherence silent =
      spectral_coherence(Eigen::VectorXd::Constant(1000, 3), rate_Hz, {.highest = 100, .bands = 4});
  CHECK(enhanced_envelope_spectrum(silent).significant(0.01).empty());
}
