#include "analysis/envelope/squared_envelope_spectrum.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/envelope/strikes.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::PeaksAt;
using test::UniformBelow;
using test::white_noise;

namespace {

constexpr double rate_Hz = 8000;
constexpr double from_Hz = 1000;
constexpr double to_Hz = 3000;

TestedSpectrum of_noise(unsigned seed, Eigen::Index n = 8000) {
  return squared_envelope_spectrum(white_noise(n, seed), rate_Hz, from_Hz, to_Hz);
}

}  // namespace

SCENARIO("the squared envelope tells how often and how deeply power swings",
         "[analysis][envelope]") {
  GIVEN("a carrier of 2 kHz that swings by 0.3 at 40 Hz, in noise") {
    const Eigen::VectorXd x =
        test::ringing({.carrier_Hz = 2000, .rate_Hz = 40, .depth = 0.3}, 8000, rate_Hz) +
        0.3 * white_noise(8000, 1);
    WHEN("its band is looked at") {
      const TestedSpectrum tested = squared_envelope_spectrum(x, rate_Hz, from_Hz, to_Hz);
      THEN("line 40 stands out of the whole spectrum, as deep as the power swings") {
        // 2m over the mean: 1 + m²/2 of twice the carrier's power, and noise in a fourth of 8 kHz
        const double mean = 1 + 0.3 * 0.3 / 2 + 2 * 0.3 * 0.3 / 2;
        CHECK(tested.spectrum.amplitude[40] == Approx(2 * 0.3 / mean).epsilon(0.05));
        CHECK(tested.p_value(40) < tested.rate_of_one_line(1e-6));
        CHECK(evidence_near(tested, 40.4, 1, 1e-3).frequency == 40);
        CHECK(evidence_near(tested, 40.4, 1, 1e-3).amplitude >
              evidence_near(tested, 40.4, 1, 1e-3).threshold);
      }
    }
    WHEN("another band is") {
      const TestedSpectrum tested = squared_envelope_spectrum(x, rate_Hz, 2500, 3900);
      THEN("nothing stands out") { CHECK(tested.significant(1e-3).empty()); }
    }
  }
}

TEST_CASE("noise of bandwidth B has a squared envelope that falls off as a triangle to B",
          "[analysis][envelope][law]") {
  // Of m independent spectral lines, m(1 - α/B) products are a line α: mean power 4(1 - α/B)/m of
  // an amplitude over the mean, and 1.5 times that under a Hann window.
  constexpr double lines = 2000;
  Eigen::VectorXd told = Eigen::VectorXd::Zero(4001);
  constexpr unsigned draws = 40;
  for (unsigned seed = 1; seed <= draws; ++seed) told += of_noise(seed).noise / draws;
  for (const Eigen::Index line : {100, 500, 1000, 1500}) {
    CAPTURE(line);
    CHECK(told[line] == Approx(6 * (1 - double(line) / lines) / lines).epsilon(0.05));
  }
}

TEST_CASE("a line of noise exceeds its threshold as often as stated",
          "[analysis][envelope][null]") {
  NullDraws of_a_line, of_all;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const TestedSpectrum tested = of_noise(seed);
    for (const Eigen::Index line : {50, 130, 400, 850}) {
      of_a_line.p_values.push_back(tested.p_value(line));
      const double level = tested.threshold(line, 0.1);
      CHECK((tested.p_value(line) < 0.1) == (tested.spectrum.amplitude[line] > level));
    }
    double least = 1;
    for (Eigen::Index line = tested.first; line <= tested.last; ++line) {
      least = std::min(least, tested.p_value(line));
    }
    of_all.p_values.push_back(least * double(tested.last - tested.first + 1));
    CHECK(tested.significant(0.1).empty() == (least >= tested.rate_of_one_line(0.1)));
  }
  CHECK_THAT(of_a_line, UniformBelow({0.01, 0.1, 0.5, 0.9}));
  CHECK_THAT(of_all, NoOftenerThanStated({0.01, 0.1}));
}

TEST_CASE("bursts without a period are loud, and no alarm", "[analysis][envelope][null]") {
  NullDraws draws;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    // As irregular as can be: the time between two has a standard deviation of half of itself.
    const Eigen::VectorXd bursts = test::Strikes{rate_Hz, 30, 2000, 500, 0.5}.samples(16000, seed);
    const Eigen::VectorXd x = bursts + 0.05 * white_noise(16000, seed);
    const TestedSpectrum tested = squared_envelope_spectrum(x, rate_Hz, from_Hz, to_Hz);
    draws.p_values.push_back(evidence_near(tested, 171, 2, 0.1).p_value);
  }
  CHECK_THAT(draws, NoOftenerThanStated({0.01, 0.1}));
}

TEST_CASE("where the spectrum ends there is no evidence", "[analysis][envelope]") {
  const TestedSpectrum tested = of_noise(1);
  CHECK(tested.last == 2000 - too_few_products);
  CHECK(evidence_near(tested, 2100, 5, 1e-3).p_value == 1);
  CHECK(evidence_near(tested, 2100, 5, 1e-3).amplitude == 0);
  CHECK(evidence_near(tested, 0.3, 0.2, 1e-3).p_value == 1);
  CHECK_THROWS_AS(tested.threshold(50, 0), std::invalid_argument);
}
