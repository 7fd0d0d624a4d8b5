#include "analysis/evidence/decoy_p_value.hpp"

#include <random>

#include "tests/analysis/null_rates.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using analysis::decoy_p_value;
using test::NoOftenerThanStated;
using test::NullDraws;

namespace {

constexpr Eigen::Index decoys_of_a_part = 96;

// Sums over noise lines, each heard in `copies` channels that share all their noise.
class Sums {
 public:
  Sums(int lines, int copies, unsigned seed) : lines_(lines), copies_(copies), engine_(seed) {}
  double draw() {
    double sum = 0;
    for (int i = 0; i < lines_; ++i) sum += power_(engine_);
    return copies_ * sum;
  }
  Eigen::VectorXd decoys(Eigen::Index count = decoys_of_a_part) {
    return Eigen::VectorXd::NullaryExpr(count, [&] { return draw(); });
  }

 private:
  int lines_, copies_;
  std::mt19937 engine_;
  std::exponential_distribution<double> power_;
};

}  // namespace

TEST_CASE("noise is no oftener beyond its decoys than stated", "[analysis][evidence][null]") {
  if (test::too_long_under_sanitizer()) return;
  const int lines = GENERATE(1, 2, 16, 200);
  const int copies = GENERATE(1, 12);
  CAPTURE(lines, copies);
  Sums sums(lines, copies, 1);
  NullDraws draws;
  for (int draw = 0; draw < 4000; ++draw) {
    draws.p_values.push_back(decoy_p_value(sums.draw(), sums.decoys()));
  }
  CHECK_THAT(draws, NoOftenerThanStated({0.001, 0.01, 0.1}));
}

TEST_CASE("the p-value is Wilson and Hilferty's where decoys are many",
          "[analysis][evidence][literature]") {
  // Abramowitz & Stegun, table 26.8: chi-squared of 40 degrees of freedom exceeds 63.691 in 1 %.
  Sums sums(20, 1, 2);
  CHECK(decoy_p_value(63.691 / 2, sums.decoys(20000)) == Approx(0.01).epsilon(0.1));
}

TEST_CASE("decoys on lines of something else do not hide a fault", "[analysis][evidence]") {
  Sums sums(8, 1, 3);
  Eigen::VectorXd decoys = sums.decoys();
  const double alone = decoy_p_value(80, decoys);
  decoys.head(12).setConstant(5000);
  CHECK(alone < 1e-6);
  CHECK(decoy_p_value(80, decoys) < 1e-5);
}

TEST_CASE("decoys that hardly differ do not make a line of noise significant",
          "[analysis][evidence]") {
  CHECK(decoy_p_value(4, Eigen::VectorXd::Constant(96, 3.999)) > 0.1);
}

TEST_CASE("without lines there is no evidence", "[analysis][evidence]") {
  CHECK(decoy_p_value(0, Eigen::VectorXd::Constant(96, 2)) == 1);
  CHECK(decoy_p_value(5, Eigen::VectorXd::Zero(96)) == 1);
  CHECK_THROWS_AS(decoy_p_value(5, Eigen::VectorXd::Ones(1)), std::invalid_argument);
}
