#include "analysis/explain/base_fit.hpp"

#include <catch2/catch.hpp>

#include "analysis/explain/pressed.hpp"

using namespace rvbench::analysis;

namespace {

// Three lines say that a number is 1, each within 0.01; a fourth that it is 0 within 0.02. At its
// nominal value 0 the three are a hundred standard errors off.
class Torn final : public ForwardModel {
 public:
  explicit Torn(double believable) : believable_(believable) {}
  const std::vector<ObservedUnit>& units() const override { return units_; }
  const std::vector<ModelParameter>& base() const override { return base_; }
  const std::vector<Candidate>& library() const override { return none_; }
  bool counts_standard_errors() const override { return true; }
  double believable() const override { return believable_; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    const double x = values[0], three = (x - 1) / 0.01;
    const Eigen::Vector4d off(three, three, three, x / 0.02);
    return off.unaryExpr([&](double r) { return pressed(r, believable_); });
  }

 private:
  double believable_;
  std::vector<ObservedUnit> units_{{"record", "condition", "", "", 0, 4}};
  std::vector<ModelParameter> base_ = [] {
    ModelParameter x;
    x.name = "x";
    x.low = -2;
    x.high = 2;
    return std::vector<ModelParameter>{x};
  }();
  std::vector<Candidate> none_;
};

}  // namespace

TEST_CASE("a base that begins far off does not give up the lines that most of it tells",
          "[analysis][explain]") {
  const Fit fit = fit_base(Torn(5), {true});
  REQUIRE(fit.values.size() == 1);
  CHECK(fit.values[0] == Approx(1).margin(0.01));
}

TEST_CASE("without pressing, a base rests where least squares does", "[analysis][explain]") {
  const Fit fit = fit_base(Torn(std::numeric_limits<double>::infinity()), {true});
  CHECK(fit.values.at(0) == Approx(3e4 / (3e4 + 2500)).epsilon(1e-4));  // weighted mean
}

TEST_CASE("what is pressed keeps small differences, and is found again", "[analysis][explain]") {
  CHECK(pressed(0.1, 5) == Approx(0.1).epsilon(1e-3));
  CHECK(pressed(-100, 5) == Approx(-5 * std::sqrt(std::log(401))));
  for (const double r : {-80.0, -3.0, 0.0, 0.5, 5.0, 1000.0}) {
    CHECK(unpressed(pressed(r, 5), 5) == Approx(r).margin(1e-9));
  }
}
