#include "analysis/station/distributions.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace rvbench::analysis;

TEST_CASE("quantiles are those of the tables", "[analysis][station][literature]") {
  // Abramowitz & Stegun (1964), tables 26.1, 26.8 and 26.9.
  CHECK(normal_quantile(0.975) == Approx(1.959964).epsilon(1e-6));
  CHECK(normal_quantile(0.001) == Approx(-3.090232).epsilon(1e-6));
  CHECK(chi_square_quantile(0.95, 10) == Approx(18.307).epsilon(1e-5));
  CHECK(chi_square_quantile(0.025, 19) == Approx(8.907).epsilon(1e-4));
  CHECK(chi_square_quantile(0.99, 1) == Approx(6.635).epsilon(1e-4));
  CHECK(f_quantile(0.95, 2, 10) == Approx(4.10).epsilon(2e-3));
  CHECK(f_quantile(0.99, 4, 20) == Approx(4.43).epsilon(2e-3));
  CHECK(f_p_value(4.10, 2, 10) == Approx(0.05).epsilon(2e-3));
}

TEST_CASE("closed forms hold", "[analysis][station]") {
  // Of two degrees of freedom chi-square is exponential; F of 2 and n falls as (1 + 2f/n)^(-n/2).
  CHECK(chi_square_probability(3, 2) == Approx(1 - std::exp(-1.5)));
  CHECK(chi_square_quantile(0.3, 2) == Approx(-2 * std::log(0.7)));
  CHECK(f_p_value(1.7, 2, 9) == Approx(std::pow(1 + 2 * 1.7 / 9, -4.5)));
  CHECK(f_quantile(0.2, 7, 5) == Approx(1 / f_quantile(0.8, 5, 7)));
  CHECK(normal_probability(normal_quantile(0.123)) == Approx(0.123));
  CHECK(normal_quantile(0.5) == Approx(0).margin(1e-12));
}

TEST_CASE("what is no probability has no quantile", "[analysis][station]") {
  for (const double p : {0.0, 1.0, -0.1, std::nan("")}) {
    CAPTURE(p);
    CHECK_THROWS_AS(normal_quantile(p), std::invalid_argument);
    CHECK_THROWS_AS(chi_square_quantile(p, 3), std::invalid_argument);
    CHECK_THROWS_AS(f_quantile(p, 3, 3), std::invalid_argument);
  }
  CHECK_THROWS_AS(chi_square_quantile(0.5, 0), std::invalid_argument);
  CHECK_THROWS_AS(f_quantile(0.5, 3, 0), std::invalid_argument);
  CHECK(chi_square_probability(-1, 3) == 0);
  CHECK(f_p_value(0, 3, 3) == 1);
}
