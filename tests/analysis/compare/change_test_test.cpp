#include "analysis/compare/change_test.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "analysis/compare/false_discovery.hpp"

namespace rvbench::analysis {

// Student's own example, hours of sleep gained by two drugs; as R's t.test(var.equal = TRUE) tells.
TEST_CASE("two means are held against each other as Student does", "[analysis][literature]") {
  const std::vector<double> first{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0, 2};
  const std::vector<double> second{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  const ChangeTest test = test_change(1.58, 10, 10, pooled_scatter(first, second), 0);
  CHECK(test.p_value == Approx(0.07919).epsilon(1e-3));
  CHECK(half_width(test) == Approx((3.363874 + 0.203874) / 2).epsilon(1e-5));
}

TEST_CASE("a change that nobody minds is no surprise however sure it is", "[analysis]") {
  const Scatter small{1e-4, 10};
  CHECK(test_change(0.8, 3, 3, small, 0).p_value < 1e-9);
  CHECK(test_change(0.8, 3, 3, small, 1).p_value > 0.99);
  CHECK(test_change(1.5, 3, 3, small, 1).p_value < 1e-9);
  CHECK(test_change(-1.5, 3, 3, small, 1).p_value == test_change(1.5, 3, 3, small, 1).p_value);
}

TEST_CASE("at the least change itself the test calls as often as it says", "[analysis]") {
  std::mt19937 engine(3);
  std::normal_distribution<double> gaussian;
  int calls = 0;
  constexpr int draws = 20000;
  for (int i = 0; i < draws; ++i) {
    std::vector<double> a, b;
    for (int k = 0; k < 3; ++k) {
      a.push_back(gaussian(engine));
      b.push_back(gaussian(engine) + 2);
    }
    const double change = (b[0] + b[1] + b[2] - a[0] - a[1] - a[2]) / 3;
    calls += test_change(change, 3, 3, pooled_scatter(a, b), 2).p_value <= 0.05 ? 1 : 0;
  }
  CHECK(calls == Approx(0.05 * draws).margin(4 * std::sqrt(0.05 * draws)));
}

TEST_CASE("a change said to be detectable is found nine times in ten", "[analysis]") {
  std::mt19937 engine(5);
  std::normal_distribution<double> gaussian;
  const Scatter known{1, 1000};
  const double change = detectable_change(test_change(0, 3, 3, known, 1), 1, 0.01);
  int found = 0;
  constexpr int draws = 5000;
  for (int i = 0; i < draws; ++i) {
    const double seen = change + gaussian(engine) * std::sqrt(2.0 / 3);
    found += test_change(seen, 3, 3, known, 1).p_value <= 0.01 ? 1 : 0;
  }
  CHECK(found == Approx(0.9 * draws).margin(4 * std::sqrt(0.09 * draws)));
}

TEST_CASE("without any scatter a change is certain, without freedom nothing is", "[analysis]") {
  CHECK(test_change(2, 3, 3, {0, 4}, 1).p_value == 0);
  CHECK(test_change(0.5, 3, 3, {0, 4}, 1).p_value == 1);
  CHECK(std::isinf(detectable_change(test_change(0, 1, 1, {0, 0}, 1), 1, 0.05)));
}

// The 15 p-values of the thrombolysis study in Benjamini & Hochberg (1995), section 4.1: at 0.05
// their procedure rejects four.
TEST_CASE("false discoveries are paid for as Benjamini and Hochberg do", "[analysis][literature]") {
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  int called = 0;
  for (const double adjusted : adjusted_p_values(p)) called += adjusted <= 0.05 ? 1 : 0;
  CHECK(called == 4);
  CHECK(adjusted_p_values(p)[0] == Approx(0.0015));
}

TEST_CASE("what was not asked is not paid for, and order does not matter", "[analysis]") {
  const double nan = std::nan("");
  const std::vector<double> adjusted = adjusted_p_values({0.04, nan, 0.01});
  CHECK(adjusted[0] == Approx(0.04));
  CHECK(std::isnan(adjusted[1]));
  CHECK(adjusted[2] == Approx(0.02));
  CHECK(adjusted_p_values({}).empty());
}

}  // namespace rvbench::analysis
