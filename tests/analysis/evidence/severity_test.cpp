#include "analysis/evidence/severity.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using analysis::Severity;
using analysis::severity_of;
using analysis::SignatureScore;

namespace {

SignatureScore score(double depth, double depth2_sd = 0) {
  SignatureScore s;
  s.depth = depth;
  s.depth2_variance = depth2_sd * depth2_sd;
  return s;
}

Severity severity(const std::vector<SignatureScore>& scores) {
  std::vector<const SignatureScore*> all;
  for (const SignatureScore& s : scores) all.push_back(&s);
  return severity_of(all);
}

}  // namespace

TEST_CASE("severity is the median depth, without noise or scatter it is certain",
          "[analysis][evidence]") {
  const Severity one = severity({score(0.3)});
  CHECK(one.depth == 0.3);
  CHECK(one.low == Approx(0.3));
  CHECK(one.high == Approx(0.3));
  CHECK(severity({score(0.1), score(0.9), score(0.2)}).depth == 0.2);
  CHECK_THROWS_AS(severity({}), std::invalid_argument);
}

TEST_CASE("of one point the interval is its noise", "[analysis][evidence]") {
  // 95 % of a Gaussian are within 1.96 deviations: of the square, 0.16 ± 0.0196.
  const Severity s = severity({score(0.4, 0.01)});
  CHECK(s.low == Approx(std::sqrt(0.16 - 0.0196)).epsilon(0.01));
  CHECK(s.high == Approx(std::sqrt(0.16 + 0.0196)).epsilon(0.01));
}

TEST_CASE("of several points the interval is their scatter, noise and all",
          "[analysis][evidence]") {
  const Severity s = severity({score(0.2, 0.3), score(0.3, 0.3), score(0.4, 0.3)});
  CHECK(s.low == 0.2);
  CHECK(s.high == 0.4);
}

TEST_CASE("in 95 of 100 matrices the interval holds the severity", "[analysis][evidence][null]") {
  if (test::too_long_under_sanitizer()) return;
  std::mt19937 engine(1);
  std::normal_distribution<double> noise;
  constexpr int matrices = 400;
  int held = 0;
  for (int matrix = 0; matrix < matrices; ++matrix) {
    std::vector<SignatureScore> points;
    for (int point = 0; point < 21; ++point) points.push_back(score(0.3 + 0.05 * noise(engine)));
    const Severity s = severity(points);
    held += s.low <= 0.3 && 0.3 <= s.high ? 1 : 0;
  }
  // The interval runs about from the 6th to the 16th of 21 values: binomial, 97 %; what resampling
  // takes off, and 4 binomial deviations.
  CHECK(held >= 0.9 * matrices);
  CHECK(held <= 0.99 * matrices);
}
