#include "analysis/spectrum.hpp"

#include <limits>

#include "tests/support/signals.hpp"
#include "tests/support/spectrum_matchers.hpp"

using namespace rvbench;
using analysis::amplitude_spectrum;
using analysis::Window;
using test::IsBelow;
using test::PeaksAt;

SCENARIO("a sine on a line reads its amplitude", "[analysis][spectrum]") {
  GIVEN("0.3 m/s² at 237 Hz, for one second") {
    const Eigen::VectorXd x = 0.3 * test::tone(237, 4960, 4960, 0.7);

    WHEN("no window is applied") {
      const auto spectrum = amplitude_spectrum(x, 4960, Window::rectangular);
      THEN("its line reads 0.3, all others nothing") {
        CHECK(spectrum.resolution == 1);
        CHECK(spectrum.amplitude.size() == 2481);
        CHECK_THAT(spectrum, PeaksAt(237));
        CHECK(spectrum.amplitude[237] == Approx(0.3).epsilon(1e-12));
        CHECK_THAT(spectrum, IsBelow(1e-13, 0, 236) && IsBelow(1e-13, 238, 2480));
      }
    }
    WHEN("the Hann window is applied") {
      const auto spectrum = amplitude_spectrum(x, 4960, Window::hann);
      THEN("its line reads 0.3, the two beside it half of that, all others nothing") {
        CHECK(spectrum.amplitude[237] == Approx(0.3).epsilon(1e-12));
        CHECK(spectrum.amplitude[236] == Approx(0.15).epsilon(1e-12));
        CHECK(spectrum.amplitude[238] == Approx(0.15).epsilon(1e-12));
        CHECK_THAT(spectrum, IsBelow(1e-13, 0, 235) && IsBelow(1e-13, 239, 2480));
      }
    }
  }
  GIVEN("a signal over shaft angle, 256 samples a revolution, 121 revolutions") {
    const Eigen::VectorXd x = test::tone(39.0 / 121, 256 * 121, 256);
    const auto spectrum = amplitude_spectrum(x, 256, Window::rectangular);
    THEN("the axis counts orders") {
      CHECK(spectrum.resolution == Approx(1.0 / 121));
      CHECK(spectrum.axis(39) == Approx(39.0 / 121));
      CHECK_THAT(spectrum, PeaksAt(39.0 / 121));
    }
  }
  GIVEN("a sine at half the sample rate") {
    const auto spectrum = amplitude_spectrum(2 * test::tone(32, 64, 64), 64, Window::rectangular);
    THEN("it reads its amplitude, too") { CHECK(spectrum.amplitude[32] == Approx(2)); }
  }
}

TEST_CASE("half-way between two lines a sine reads low by the scallop loss",
          "[analysis][spectrum][literature]") {
  // Harris, Proc. IEEE 66(1), 51-83 (1978), table 1: 3.92 dB without a window, 1.42 dB for Hann.
  const Eigen::VectorXd x = test::tone(1000.5, 4960, 4960);
  const auto loss_dB = [&](Window window) {
    return -20 * std::log10(amplitude_spectrum(x, 4960, window).amplitude.maxCoeff());
  };
  CHECK(loss_dB(Window::rectangular) == Approx(3.92).margin(0.005));
  CHECK(loss_dB(Window::hann) == Approx(1.42).margin(0.005));
}

TEST_CASE("the lines carry the power of the signal", "[analysis][spectrum][law]") {
  for (const Eigen::Index n : {2, 3, 1000, 1009, 4961}) {
    CAPTURE(n);
    const Eigen::VectorXd x = test::white_noise(n, 4).array() - 0.5;
    const auto a = amplitude_spectrum(x, 1, Window::rectangular).amplitude;
    double power = a[0] * a[0] + a.tail(a.size() - 1).squaredNorm() / 2;
    if (n % 2 == 0) power += a[n / 2] * a[n / 2] / 2;  // an alternating signal has no rms of a/√2
    CHECK(power == Approx(x.squaredNorm() / static_cast<double>(n)).epsilon(1e-12));
  }
}

TEST_CASE("an offset stays in line 0", "[analysis][spectrum]") {
  const Eigen::VectorXd x = test::tone(10, 1000, 1000).array() - 5000;
  const auto window = GENERATE(Window::rectangular, Window::hann);
  const auto spectrum = amplitude_spectrum(x, 1000, window);
  CHECK(spectrum.amplitude[0] == Approx(5000).epsilon(1e-15));
  CHECK_THAT(spectrum, IsBelow(1e-10, 1, 8));
  CHECK(spectrum.amplitude[10] == Approx(1).epsilon(1e-11));
}

TEST_CASE("silence has no lines", "[analysis][spectrum]") {
  const auto window = GENERATE(Window::rectangular, Window::hann);
  CHECK(amplitude_spectrum(Eigen::VectorXd::Zero(101), 10, window).amplitude.isZero(0));
}

TEST_CASE("amplitude_spectrum refuses what it cannot answer", "[analysis][spectrum][errors]") {
  Eigen::VectorXd x = test::tone(10, 100, 100);
  const auto spectrum = [&](Eigen::Index n, double rate) {
    return amplitude_spectrum(x.head(n), rate, Window::hann);
  };
  CHECK_NOTHROW(spectrum(2, 100));
  CHECK_THROWS_AS(spectrum(1, 100), std::invalid_argument);
  CHECK_THROWS_AS(spectrum(0, 100), std::invalid_argument);
  CHECK_THROWS_AS(spectrum(100, 0), std::invalid_argument);
  CHECK_THROWS_AS(spectrum(100, std::nan("")), std::invalid_argument);
  x[50] =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  CHECK_THROWS_AS(spectrum(100, 100), std::invalid_argument);
}
