#include "analysis/hilbert.hpp"

#include <limits>

#include "analysis/spectrum.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using analysis::amplitude_spectrum;
using analysis::envelope;
using analysis::Window;
using test::IsBelow;
using test::PeaksAt;

SCENARIO("a struck resonance betrays how often and how hard it is struck", "[analysis][hilbert]") {
  GIVEN("a 1 kHz resonance whose amplitude swings 30 % at 40 Hz") {
    const Eigen::VectorXd x =
        test::ringing({.carrier_Hz = 1000, .rate_Hz = 40, .depth = 0.3}, 4960, 4960);
    const Eigen::VectorXd found = envelope(x);

    THEN("the envelope is that swing") {
      const Eigen::VectorXd swing = 1 + 0.3 * test::tone(40, 4960, 4960).array();
      CHECK((found - swing).cwiseAbs().maxCoeff() < 1e-12);
    }
    THEN("its spectrum has one line: the striking rate, as high as the swing") {
      const auto spectrum = amplitude_spectrum(found, 4960, Window::rectangular);
      CHECK(spectrum.amplitude[0] == Approx(1).epsilon(1e-12));
      CHECK(spectrum.amplitude[40] == Approx(0.3).epsilon(1e-12));
      CHECK_THAT(spectrum, IsBelow(1e-12, 1, 39) && IsBelow(1e-12, 41, 2480));
    }
  }
  GIVEN("the resonance ringing evenly") {
    const Eigen::VectorXd found = envelope(test::tone(1000, 4960, 4960, 0.4));
    THEN("the envelope betrays nothing") { CHECK((found.array() - 1).abs().maxCoeff() < 1e-12); }
  }
}

TEST_CASE("the envelope of a steady tone is its amplitude at any length",
          "[analysis][hilbert][law]") {
  for (const Eigen::Index n : {4, 5, 7, 1009, 4096, 10007}) {
    CAPTURE(n);
    const auto rate_Hz = static_cast<double>(n);
    const Eigen::VectorXd found = envelope(2.5 * test::tone(1, n, rate_Hz, 0.3));
    CHECK((found.array() - 2.5).abs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("a mean and a swing at half the sample rate have no quadrature", "[analysis][hilbert]") {
  CHECK((envelope(Eigen::VectorXd::Constant(9, -3)).array() - 3).abs().maxCoeff() < 1e-14);
  CHECK((envelope(test::tone(32, 64, 64)).array() - 1).abs().maxCoeff() < 1e-13);
  CHECK(envelope(Eigen::VectorXd::Zero(100)).isZero(0));
}

TEST_CASE("the envelope spectrum of a gear-like minute is scipy's",
          "[analysis][hilbert][literature][data]") {
  const auto x = test::reference_data("rv_60s.f64");
  const auto expected = test::reference_data("env_spec_ref_rv_60s.f64");
  if (!x || !expected) return;

  const auto spectrum = amplitude_spectrum(envelope(*x), 4960, Window::rectangular);
  REQUIRE(spectrum.amplitude.size() == expected->size());
  // The file has the mean taken out, and scales half the sample rate (its last line) like the rest.
  const Eigen::VectorXd difference = spectrum.amplitude - *expected;
  const Eigen::Index lines = expected->size();
  CHECK(difference.segment(1, lines - 2).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(2 * spectrum.amplitude[lines - 1] == Approx((*expected)[lines - 1]).epsilon(1e-10));
}

TEST_CASE("envelope refuses what it cannot answer", "[analysis][hilbert][errors]") {
  Eigen::VectorXd x = test::tone(10, 100, 100);
  CHECK_NOTHROW(envelope(x.head(4)));
  CHECK_THROWS_AS(envelope(x.head(3)), std::invalid_argument);
  CHECK_THROWS_AS(envelope(Eigen::VectorXd()), std::invalid_argument);
  x[50] =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(envelope(x), std::invalid_argument);
}

TEST_CASE("a carrier is known by its zero crossings, however it swells", "[analysis][hilbert]") {
  const Eigen::VectorXd x =
      test::ringing({.carrier_Hz = 1000, .rate_Hz = 40, .depth = 0.3}, 4960, 4960);
  CHECK(analysis::crossing_frequency(x, 4960) == Approx(1000).epsilon(2e-3));
  CHECK(analysis::crossing_frequency(x, 49.6) == Approx(10).epsilon(2e-3));
  CHECK(analysis::crossing_frequency(Eigen::VectorXd::Zero(1), 4960) == 0);
}
