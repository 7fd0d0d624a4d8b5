#include "analysis/evidence/growth_law.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace rvbench;
using analysis::Examination;
using analysis::growth_law;
using analysis::GrowthLaw;

namespace {

// Points of the matrix, vibrating by load^p·speed^q, and a scatter in the logarithm.
class Matrix {
 public:
  Matrix(double p, double q, double scatter = 0, unsigned seed = 1) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> noise;
    for (const double speed_rpm : {605.0, 1210.0, 1815.0}) {
      for (const double load_pct : {0.0, 25.0, 50.0, 75.0, 100.0, 125.0, 150.0}) {
        Examination e;
        e.speed_rpm = speed_rpm;
        e.load_pct = load_pct;
        e.channels.resize(2);
        e.scores.resize(1);
        for (std::size_t c = 0; c < 2; ++c) {
          e.scores[0].channel_amplitudes.push_back((c == 0 ? 3 : 7) * std::pow(speed_rpm, q) *
                                                   std::pow(load_pct, p) *
                                                   std::exp(scatter * noise(engine)));
        }
        points_.push_back(e);
      }
    }
  }
  std::vector<const Examination*> where(bool (*wanted)(const Examination&)) const {
    std::vector<const Examination*> list;
    for (const Examination& e : points_) {
      if (wanted(e)) list.push_back(&e);
    }
    return list;
  }
  GrowthLaw law() const {
    return growth_law(where([](const Examination&) { return true; }), 0);
  }

 private:
  std::vector<Examination> points_;
};

}  // namespace

TEST_CASE("exponents of load and speed are those that it grows by", "[analysis][evidence]") {
  for (const auto& [p, q] : {std::pair{1.0, 2.0}, {0.0, 2.0}, {0.33, 0.0}, {-1.0, 1.0}}) {
    const GrowthLaw law = Matrix(p, q).law();
    CHECK(law.load.exponent == Approx(p).margin(1e-9));
    CHECK(law.speed.exponent == Approx(q).margin(1e-9));
    CHECK(law.load.error < 1e-6);
  }
}

TEST_CASE("95 of 100 intervals hold the exponent", "[analysis][evidence][null]") {
  constexpr int matrices = 400;
  int held = 0;
  for (unsigned seed = 1; seed <= matrices; ++seed) {
    const GrowthLaw law = Matrix(1, 2, 0.2, seed).law();
    held += std::abs(law.load.exponent - 1) <= law.load.error ? 1 : 0;
  }
  CHECK(held == Approx(0.95 * matrices).margin(4 * std::sqrt(0.95 * 0.05 * matrices)));
}

TEST_CASE("what does not vary has no exponent", "[analysis][evidence]") {
  const Matrix matrix(1, 2, 0.1);
  const GrowthLaw one_load =
      growth_law(matrix.where([](const Examination& e) { return e.load_pct == 100; }), 0);
  CHECK(std::isnan(one_load.load.exponent));
  const GrowthLaw one_speed =
      growth_law(matrix.where([](const Examination& e) { return e.speed_rpm == 605; }), 0);
  CHECK(std::isnan(one_speed.speed.exponent));
  CHECK(one_speed.load.exponent == Approx(1).margin(one_speed.load.error));
  CHECK(std::isnan(growth_law({}, 0).load.exponent));
}

TEST_CASE("speed and load that went together are not told apart", "[analysis][evidence]") {
  const Matrix matrix(1, 2, 0.1);
  auto points = matrix.where([](const Examination& e) {
    return (e.speed_rpm == 605 && e.load_pct == 50) || (e.speed_rpm == 1210 && e.load_pct == 100) ||
           (e.speed_rpm == 1815 && e.load_pct == 150);
  });
  REQUIRE(points.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) points.push_back(points[i]);  // enough of them
  CHECK(std::isnan(growth_law(points, 0).load.exponent));
}

TEST_CASE("a channel that misses it once does not move the exponent", "[analysis][evidence]") {
  const Matrix matrix(1, 2);
  auto points = matrix.where([](const Examination& e) { return e.speed_rpm == 605; });
  Examination deaf = *points.back();
  deaf.scores[0].channel_amplitudes[1] = 0;
  points.back() = &deaf;
  CHECK(growth_law(points, 0).load.exponent == Approx(1).margin(1e-9));
}

TEST_CASE("a point where noise alone shows it has no amplitude, and spoils no exponent",
          "[analysis][evidence]") {
  const Matrix matrix(1, 2);
  auto points = matrix.where([](const Examination& e) { return e.speed_rpm == 605; });
  Examination noisy = *points.back();
  noisy.scores[0].by_noise = true;
  noisy.scores[0].channel_amplitudes.clear();
  points.back() = &noisy;
  CHECK(growth_law(points, 0).load.exponent == Approx(1).margin(1e-9));
}

TEST_CASE("an exponent speaks against a mechanism by how far it is outside its range",
          "[analysis][evidence]") {
  const analysis::GrowthRange range{0, 1};
  CHECK(analysis::p_value_of_growth({0.5, 0.1, 5}, range) == 1);
  CHECK(analysis::p_value_of_growth({1.0, 0.1, 5}, range) == 1);
  // The interval's end, and one and a half of it: t = 3.86 with 5 degrees of freedom.
  CHECK(analysis::p_value_of_growth({1.1, 0.1, 5}, range) == Approx(0.05).epsilon(1e-4));
  CHECK(analysis::p_value_of_growth({-0.1, 0.1, 5}, range) == Approx(0.05).epsilon(1e-4));
  CHECK(analysis::p_value_of_growth({1.15, 0.1, 5}, range) == Approx(0.0119298).epsilon(1e-4));
  CHECK(analysis::p_value_of_growth({2.0, 0.0, 5}, range) == 0);
  CHECK(analysis::p_value_of_growth({0.5, 0.0, 5}, range) == 1);
  CHECK(analysis::p_value_of_growth({}, range) == 1);
}

TEST_CASE("a p-value leaves at most -e p ln p of the odds", "[analysis][evidence]") {
  CHECK(analysis::odds_at_most(1) == 1);
  CHECK(analysis::odds_at_most(0.5) == 1);
  // Table 1 of Sellke, Bayarri & Berger (2001).
  CHECK(analysis::odds_at_most(0.05) == Approx(0.407).margin(5e-4));
  CHECK(analysis::odds_at_most(0.001) == Approx(0.0188).margin(5e-5));
  CHECK(analysis::odds_at_most(0) == 0);
}
