#include "analysis/explain/screen.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/explain/plain_model.hpp"

using namespace rvbench::analysis;

namespace {

// A weight of 1 N that hangs on an axis and is known within `spread_N`, and what brakes the axis
// forward only by 2 N: two thirds of the time it moves forward, where one is nearly the other.
class Axis final : public rvbench::test::PlainModel {
 public:
  explicit Axis(double spread_N) {
    base_ = {{.name = "weight", .unit = "N", .nominal = 1, .spread = spread_N}};
    Candidate brake;
    brake.name = "asymmetric_friction";
    brake.parameters = {{.name = "level", .unit = "N"}};
    brake.starts = {{1}, {-1}};
    library_ = {brake};
    for (Eigen::Index i = 0; i < units; ++i)
      units_.push_back({"r", std::to_string(i), "", "", 3 * i, 3});
  }

  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    Eigen::VectorXd apart(3 * units);
    for (Eigen::Index i = 0; i < apart.size(); ++i) {
      const double forward = i % 3 == 0 ? 0 : 1;
      apart[i] = 1 + 2 * forward + 0.1 * std::sin(12.9898 * static_cast<double>(i)) - values[0];
      if (!effects.empty()) apart[i] -= values[1] * forward;
    }
    return apart;
  }
  bool counts_standard_errors() const override { return true; }

  static constexpr Eigen::Index units = 12;
};

Screened screened(double spread_N) {
  const Axis axis(spread_N);
  const std::vector<bool> everything(static_cast<std::size_t>(Axis::units), true);
  Fit fit;
  fit.values = {1};
  fit.residuals = *axis.residuals({}, fit.values, everything);
  fit = polish(axis, fit, everything);
  Marks marks;
  const auto all = screen(axis, fit, everything, marks);
  REQUIRE(all.size() == 1);
  return all.front();
}

}  // namespace

TEST_CASE("an effect is credited with what the base cannot do within what is known of it",
          "[analysis][explain][screen]") {
  const Screened known = screened(1e-3), open = screened(1e3);
  CHECK(known.explains > 0.99);
  CHECK(known.start.front() == Approx(2).epsilon(0.05));
  CHECK(known.p_value < 1e-6);
  // Where the weight may be anything, the third of the time that it moves back tells them apart.
  CHECK(open.explains > 0.9);
  CHECK(open.start.front() == Approx(2).epsilon(0.05));
  CHECK(std::abs(known.scores.sum()) > 1.5 * std::abs(open.scores.sum()));
}
