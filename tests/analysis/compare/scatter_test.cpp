#include "analysis/compare/scatter.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "analysis/compare/change_test.hpp"

namespace rvbench::analysis {
namespace {

std::vector<double> drawn(std::size_t count, double deviation, std::mt19937& engine) {
  std::normal_distribution<double> gaussian(0, deviation);
  std::vector<double> x(count);
  for (double& v : x) v = gaussian(engine);
  return x;
}

}  // namespace

TEST_CASE("scatter is pooled within both groups, not between them", "[analysis]") {
  const Scatter s = pooled_scatter({1, 3}, {11, 13, 15});
  CHECK(s.freedom == 3);
  CHECK(s.variance == Approx((2 + 8) / 3.0));
  CHECK(pooled_scatter({1}, {5}).freedom == 0);
  CHECK(pooled_scatter({1}, {5, 7}).variance == Approx(2));
}

TEST_CASE("estimates of one variance become one estimate of it", "[analysis]") {
  std::mt19937 engine(1);
  std::vector<Scatter> all;
  for (int i = 0; i < 400; ++i) all.push_back(pooled_scatter(drawn(3, 0.5, engine), {}));
  for (const Scatter& s : drawn_together(all)) {
    REQUIRE(s.variance == Approx(0.25).epsilon(0.25));
    REQUIRE(s.freedom > 10);  // instead of 2
  }
}

TEST_CASE("estimates of many kinds stay themselves", "[analysis]") {
  std::mt19937 engine(1);
  std::vector<Scatter> all;
  for (int i = 0; i < 200; ++i) {
    const double deviation = std::pow(10, -3 + 6 * i / 199.0);  // over six decades
    all.push_back(pooled_scatter(drawn(4, deviation, engine), {}));
  }
  const std::vector<Scatter> together = drawn_together(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    REQUIRE(together[i].variance == all[i].variance);
    REQUIRE(together[i].freedom == 3);
  }
}

TEST_CASE("few estimates say nothing about each other", "[analysis]") {
  const std::vector<Scatter> few(9, Scatter{1, 4});
  for (const Scatter& s : drawn_together(few)) CHECK(s.freedom == 4);
  std::vector<Scatter> without(30, Scatter{0, 0});
  CHECK(drawn_together(without).front().freedom == 0);
}

TEST_CASE("a dozen estimates of two variances do not pass for estimates of one", "[analysis]") {
  // Half of them four times the other: drawn to one variance, those would be called too often.
  std::mt19937 engine(3);
  int calls = 0;
  constexpr int kinds = 3000, cells = 12;
  for (int kind = 0; kind < kinds; ++kind) {
    std::vector<Scatter> scatter;
    std::vector<double> change;
    for (int i = 0; i < cells; ++i) {
      const double deviation = 1 + i % 2;
      const std::vector<double> a = drawn(3, deviation, engine), b = drawn(3, deviation, engine);
      scatter.push_back(pooled_scatter(a, b));
      change.push_back((b[0] + b[1] + b[2] - a[0] - a[1] - a[2]) / 3);
    }
    scatter = drawn_together(scatter);
    for (std::size_t i = 0; i < cells; ++i) {
      calls += test_change(change[i], 3, 3, scatter[i], 0).p_value <= 0.001 ? 1 : 0;
    }
  }
  CHECK(calls <= 36 + 3 * std::sqrt(36.0));
}

// p-values stay p-values: with variances as the prior has them they are uniform.
TEST_CASE("learning scatter from each other keeps the rate of false calls", "[analysis]") {
  std::mt19937 engine(7);
  std::chi_squared_distribution<double> prior(6);
  int calls = 0;
  constexpr int cells = 20000;
  std::vector<Scatter> scatter;
  std::vector<double> change;
  for (int i = 0; i < cells; ++i) {
    const double deviation = std::sqrt(6 / prior(engine));
    const std::vector<double> a = drawn(3, deviation, engine), b = drawn(3, deviation, engine);
    scatter.push_back(pooled_scatter(a, b));
    change.push_back((b[0] + b[1] + b[2] - a[0] - a[1] - a[2]) / 3);
  }
  scatter = drawn_together(scatter);
  CHECK(scatter.front().freedom == Approx(10).margin(1));  // 6 of the prior, 4 of its own
  for (std::size_t i = 0; i < cells; ++i) {
    calls += test_change(change[i], 3, 3, scatter[i], 0).p_value <= 0.001 ? 1 : 0;
  }
  CHECK(calls > 20 - 3 * std::sqrt(20.0));
  CHECK(calls < 20 + 3 * std::sqrt(20.0));
}

}  // namespace rvbench::analysis
