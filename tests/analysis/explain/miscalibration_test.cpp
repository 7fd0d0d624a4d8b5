#include "analysis/explain/miscalibration.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/explain/plain_model.hpp"

using namespace rvbench::analysis;

namespace {

// A stiffness that the drawing states as 100 N/m within 10, which is two spreads.
class OneStiffness final : public rvbench::test::PlainModel {
 public:
  explicit OneStiffness(const ModelParameter& stiffness) { base_ = {stiffness}; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>&,
                                           const std::vector<bool>&) const override {
    return std::nullopt;
  }
};

const ModelParameter by_spread{"spring/stiffness", "N/m", 100, 10, 1000, 5, 1, false};

std::string said_of(double value, double standard_error,
                    const ModelParameter& stiffness = by_spread) {
  Fit fit;
  fit.values = {value};
  fit.covariance = Eigen::MatrixXd::Constant(1, 1, standard_error * standard_error);
  return miscalibration(OneStiffness(stiffness), fit);
}

}  // namespace

TEST_CASE("a number that is clearly off what is known of it is miscalibrated",
          "[analysis][explain]") {
  CHECK(said_of(130, 2) == "spring/stiffness had to go to 130 N/m, known as 100 within 10");
  CHECK_FALSE(said_of(70, 2).empty());
}

TEST_CASE("what is known of a number speaks until the data are sure", "[analysis][explain]") {
  CHECK(said_of(109, 0.1).empty());  // within its tolerance
  CHECK(said_of(114, 0.1).empty());  // a little more than stated
  CHECK(said_of(117, 5).empty());    // far off, and may be within it all the same
  CHECK_FALSE(said_of(117, 2).empty());
}

TEST_CASE("a number at its bound is miscalibrated whatever its error", "[analysis][explain]") {
  CHECK_FALSE(said_of(1000, 1e6).empty());
}

TEST_CASE("a number known within bounds alone is miscalibrated if the data know better",
          "[analysis][explain]") {
  ModelParameter bounded = by_spread;
  bounded.low = 90;
  bounded.high = 110;
  bounded.spread = std::numeric_limits<double>::infinity();
  CHECK_FALSE(said_of(110, 2, bounded).empty());
  CHECK(said_of(110, 30, bounded).empty());  // anywhere within the bounds would do as well
}
