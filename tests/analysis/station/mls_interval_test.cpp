#include "analysis/station/mls_interval.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace rvbench::analysis;

TEST_CASE("of one mean square the interval is that of chi-square",
          "[analysis][station][literature]") {
  // 10 degrees of freedom, 90 %: 3.940 and 18.307 (Abramowitz & Stegun, table 26.8).
  const ConfidenceInterval interval = mls_interval({{2, 5, 10}}, 0.9);
  CHECK(interval.low == Approx(10 * 10 / 18.307).epsilon(1e-4));
  CHECK(interval.high == Approx(10 * 10 / 3.940).epsilon(1e-3));
}

TEST_CASE("a difference is told from 0 where F tells it", "[analysis][station]") {
  // F(5, 20) is 3.289 at 97.5 %: there the lower end of a 95 % interval is 0.
  const auto low = [](double ratio) {
    return mls_interval({{0.1, ratio, 5}, {-0.1, 1, 20}}, 0.95).low;
  };
  CHECK(low(3.289) == Approx(0).margin(1e-3));
  CHECK(low(4) > 0);
  CHECK(low(2.6) < 0);
}

TEST_CASE("sums and differences are held as often as stated", "[analysis][station]") {
  // Expected mean squares 9, 3 and 1: their sum with these coefficients is known.
  const double sign = GENERATE(1.0, -1.0);
  CAPTURE(sign);
  std::mt19937 engine(3);
  std::chi_squared_distribution<double> of_9(9), of_18(18), of_60(60);
  const double truth = 9 + sign * 0.5 * 3 + 0.3;
  constexpr int draws = 300;
  int held = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const double m9 = 9 * of_9(engine) / 9, m18 = 3 * of_18(engine) / 18, m60 = of_60(engine) / 60;
    const ConfidenceInterval interval =
        mls_interval({{1, m9, 9}, {sign * 0.5, m18, 18}, {0.3, m60, 60}}, 0.9);
    held += interval.low <= truth && truth <= interval.high ? 1 : 0;
  }
  CHECK(double(held) / draws == Approx(0.9).margin(4 * std::sqrt(0.09 / draws)));
}

TEST_CASE("an interval of nothing, or of certainty, does not exist", "[analysis][station]") {
  CHECK_THROWS_AS(mls_interval({}, 0.95), std::invalid_argument);
  CHECK_THROWS_AS(mls_interval({{1, 1, 1}}, 1), std::invalid_argument);
}
