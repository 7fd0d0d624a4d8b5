#include "sim/anti_alias_filter.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;

namespace {

constexpr double rate_Hz = 4960;
constexpr double sampling_Hz = 496;
constexpr int scans_per_sample = 10;
constexpr Eigen::Index second = 4960;

Eigen::VectorXd filtered(const Eigen::VectorXd& signal) {
  sim::AntiAliasFilter filter(rate_Hz, sampling_Hz);
  return signal.unaryExpr([&](double value) { return filter.step(value); });
}

// What an ADC takes from the second second of a signal, when the filter has come to rest.
Eigen::VectorXd sampled(const Eigen::VectorXd& signal) {
  Eigen::VectorXd samples(second / scans_per_sample);
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    samples[i] = signal[second + i * scans_per_sample];
  }
  return samples;
}

// Of a line of whole Hz, over one second.
double amplitude(const Eigen::VectorXd& signal, double frequency_Hz) {
  std::complex<double> sum = 0;
  const auto n = static_cast<double>(signal.size());
  for (Eigen::Index i = 0; i < signal.size(); ++i) {
    sum += signal[i] * std::polar(1.0, -units::two_pi * frequency_Hz * double(i) / n);
  }
  return 2 * std::abs(sum) / n;
}

double measured_gain(double frequency_Hz) {
  return amplitude(filtered(test::tone(frequency_Hz, 2 * second, rate_Hz)).tail(second),
                   frequency_Hz);
}

// The polynomial itself, T10(x), where the filter is made of its zeros.
double chebyshev10(double x) {
  const double y = x * x;
  return -1 + y * (50 + y * (-400 + y * (1120 + y * (-1280 + y * 512))));
}

double inverse_chebyshev_gain(double frequency_Hz) {
  const auto warped = [](double f_Hz) { return std::tan(std::numbers::pi * f_Hz / rate_Hz); };
  const double epsilon = 1 / std::sqrt(1e6 - 1);
  const double ripple = epsilon * chebyshev10(warped(0.6 * sampling_Hz) / warped(frequency_Hz));
  return std::abs(ripple) / std::hypot(1, ripple);
}

}  // namespace

SCENARIO("the anti-alias filter has the gain of an inverse Chebyshev low-pass", "[sim][law]") {
  for (const double f_Hz :
       {1.0, 60.0, 150.0, 198.0, 230.0, 248.0, 290.0, 298.0, 359.0, 700.0, 1500.0, 2470.0}) {
    INFO(f_Hz << " Hz");
    CHECK(measured_gain(f_Hz) == Approx(inverse_chebyshev_gain(f_Hz)).margin(1e-9));
  }
}

SCENARIO("what is compared passes the anti-alias filter, and what folds onto it does not",
         "[sim]") {
  THEN("up to 0.4 of the sample rate the gain is within 1 % of 1") {
    for (double f_Hz = 1; f_Hz <= 0.4 * sampling_Hz; ++f_Hz) {
      INFO(f_Hz << " Hz");
      CHECK(measured_gain(f_Hz) == Approx(1).margin(0.01));
    }
  }
  THEN("from 0.6 of it on, less than 0.001 is left") {
    for (double f_Hz = 298; f_Hz < rate_Hz / 2; f_Hz += 17) {
      INFO(f_Hz << " Hz");
      CHECK(measured_gain(f_Hz) < 1.001e-3);
    }
  }
}

SCENARIO("a mesh line above half the sample rate does not show as another", "[sim]") {
  GIVEN("a tone of 359 Hz, which samples at 496 Hz cannot tell from one of 137 Hz") {
    const Eigen::VectorXd mesh = test::tone(359, 2 * second, rate_Hz);
    REQUIRE(amplitude(sampled(mesh), 137) == Approx(1));
    THEN("behind the filter, less than 0.001 of it is left there") {
      CHECK(amplitude(sampled(filtered(mesh)), 137) < 1e-3);
    }
    THEN("a true line at 137 Hz beside it keeps its amplitude") {
      const Eigen::VectorXd both = 20 * mesh + test::tone(137, 2 * second, rate_Hz);
      CHECK(amplitude(sampled(filtered(both)), 137) == Approx(1).margin(0.021));
    }
  }
}

SCENARIO("the anti-alias filter does not keep an overload from the interlocks", "[sim]") {
  const Eigen::VectorXd answer = filtered(Eigen::VectorXd::Ones(second));
  const auto late_s = [&](double level) {
    const auto reached = std::ranges::find_if(answer, [&](double value) { return value >= level; });
    return double(reached - answer.begin()) / rate_Hz;
  };
  THEN("a step is told within 5 ms") { CHECK(late_s(0.99) < 0.005); }
  THEN("it overshoots by no more than a fifth") { CHECK(answer.maxCoeff() < 1.2); }
  THEN("a constant torque stays what it is") {
    CHECK(answer.tail(second / 2).maxCoeff() == Approx(1).epsilon(1e-12));
    CHECK(answer.tail(second / 2).minCoeff() == Approx(1).epsilon(1e-12));
  }
}

SCENARIO("an anti-alias filter without room for its stop band is refused", "[sim]") {
  CHECK_THROWS_AS(sim::AntiAliasFilter(496, 496), std::invalid_argument);
  CHECK_THROWS_AS(sim::AntiAliasFilter(4960, 0), std::invalid_argument);
  CHECK_THROWS_AS(sim::AntiAliasFilter(not_known, 496), std::invalid_argument);
}
