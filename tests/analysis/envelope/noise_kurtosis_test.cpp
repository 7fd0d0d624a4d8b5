#include "analysis/envelope/noise_kurtosis.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "tests/analysis/null_rates.hpp"

using namespace rvbench::analysis;
using rvbench::test::NoOftenerThanStated;
using rvbench::test::NullDraws;
using rvbench::test::UniformBelow;

namespace {

Eigen::VectorXcd complex_noise(Eigen::Index n, std::mt19937& generator) {
  std::normal_distribution<double> gaussian;
  return Eigen::VectorXcd::NullaryExpr(n, [&](Eigen::Index) {
    const double real = gaussian(generator);
    return std::complex<double>(real, gaussian(generator));
  });
}

NullDraws draws_of(int draws, Eigen::Index samples) {
  std::mt19937 generator(1);
  NullDraws result;
  for (int i = 0; i < draws; ++i) {
    const double kurtosis = complex_kurtosis(complex_noise(samples, generator));
    result.p_values.push_back(noise_kurtosis_p_value(kurtosis, double(samples)));
  }
  return result;
}

}  // namespace

TEST_CASE("complex samples have the kurtosis of their powers", "[analysis][envelope]") {
  const Eigen::VectorXcd tone = Eigen::VectorXcd::NullaryExpr(
      64, [](Eigen::Index i) { return std::polar(3.0, 0.7 * double(i)); });
  CHECK(complex_kurtosis(tone) == Approx(-1));
  Eigen::VectorXcd strike = Eigen::VectorXcd::Zero(64);  // one of 64: 64 - 2
  strike[9] = {0, 5};
  CHECK(complex_kurtosis(strike) == Approx(62));
  CHECK(complex_kurtosis(Eigen::VectorXcd::Zero(64)) == 0);
}

TEST_CASE("noise shows a kurtosis as often as its p-value says", "[analysis][envelope][null]") {
  CHECK_THAT(draws_of(3000, 1000), UniformBelow({0.01, 0.1, 0.5, 0.9}));
}

TEST_CASE("and with few samples no oftener", "[analysis][envelope][null]") {
  const Eigen::Index samples = GENERATE(16, 32, 100);
  CAPTURE(samples);
  CHECK_THAT(draws_of(10000, samples), NoOftenerThanStated({0.001, 0.01, 0.1}));
}

TEST_CASE("a high kurtosis of few samples is one large sample, and as likely as that",
          "[analysis][envelope][literature]") {
  // Greenwood's statistic G = (K + 2)/M exceeds g² if one part alone exceeds g, which of M parts of
  // a line cut at random one does with M(1 - g)^(M - 1) for g above 1/2;
  // below that two may, too, but rarely.
  constexpr double m = 400, g = 0.06;
  const double one_large = m * std::pow(1 - g, m - 1);                  // 7.6e-9
  const double kurtosis = m * (g * g + 2 * (1 - g) * (1 - g) / m) - 2;  // the others as in the mean
  CHECK(std::log(noise_kurtosis_p_value(kurtosis, m)) == Approx(std::log(one_large)).epsilon(0.1));
}

TEST_CASE("correlated samples count for fewer: M(1 - a⁴)/(1 + a⁴) where they correlate by a^|τ|",
          "[analysis][envelope]") {
  constexpr Eigen::Index n = 4096;
  for (const double a : {0.0, 0.5, 0.9}) {
    CAPTURE(a);
    const Eigen::VectorXd power = Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index k) {
      return 1 / std::norm(1.0 - std::polar(a, 2 * std::numbers::pi * double(k) / double(n)));
    });
    const double a4 = std::pow(a, 4);
    CHECK(independent_samples(power, n) == Approx(n * (1 - a4) / (1 + a4)).epsilon(1e-6));
  }
  CHECK(independent_samples(Eigen::VectorXd::Zero(8), 8) == 8);
  Eigen::VectorXd tone = Eigen::VectorXd::Zero(8);
  tone[3] = 1;
  CHECK(independent_samples(tone, 8) == 1);
}

TEST_CASE("what is no kurtosis of samples throws", "[analysis][envelope]") {
  CHECK_THROWS_AS(noise_kurtosis_p_value(std::nan(""), 100), std::invalid_argument);
  CHECK_THROWS_AS(noise_kurtosis_p_value(1, 1), std::invalid_argument);
}
