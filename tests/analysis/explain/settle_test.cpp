#include "analysis/explain/settle.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/explain/plain_model.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

// A wave beside a line of its own frequency, seen by amplitude alone under conditions that each
// turn it by another phase: one that stands alone has no phase, one beside a line has.
class Amplitudes final : public test::PlainModel {
 public:
  // @param beside  amplitude of the line
  explicit Amplitudes(double beside) : beside_(beside) {
    Candidate wave;
    wave.name = "wave";
    wave.parameters = {{.name = "size, cosine part", .unit = "m", .low = -bound, .high = bound},
                       {.name = "size, sine part", .unit = "m", .low = -bound, .high = bound}};
    wave.sizes = 2;
    wave.phasor = {"size", "phase"};
    library_ = {wave};
    for (Eigen::Index i = 0; i < conditions; ++i) {
      units_.push_back({"r", std::to_string(i), "", "", i, 1});
    }
  }

  Eigen::VectorXd shown(double cosine, double sine) const {
    Eigen::VectorXd amplitudes(conditions);
    for (Eigen::Index i = 0; i < conditions; ++i) {
      amplitudes[i] = std::hypot(cosine + beside_ * std::cos(i), sine + beside_ * std::sin(i));
    }
    return amplitudes;
  }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    Eigen::VectorXd measured = shown(true_cosine, true_sine);
    for (Eigen::Index i = 0; i < conditions; ++i) measured[i] += i % 2 == 0 ? noise : -noise;
    return measured - shown(values[0], values[1]);
  }

  static constexpr Eigen::Index conditions = 8;
  static constexpr double true_cosine = 1.0, true_sine = -2.0, noise = 0.02;
  static constexpr double bound = 5;

 private:
  double beside_;
};

Eigen::MatrixXd slopes_at(const Amplitudes& model, double cosine, double sine) {
  constexpr double step = 1e-6;
  Eigen::MatrixXd slopes(Amplitudes::conditions, 2);
  slopes.col(0) =
      (model.shown(cosine - step, sine) - model.shown(cosine + step, sine)) / (2 * step);
  slopes.col(1) =
      (model.shown(cosine, sine - step) - model.shown(cosine, sine + step)) / (2 * step);
  return slopes;
}

std::optional<Evaluated> settled_from(const Amplitudes& model, double cosine, double sine,
                                      const Eigen::MatrixXd& slopes) {
  const std::vector<std::size_t> effects{0};
  const std::vector<bool> everything(static_cast<std::size_t>(Amplitudes::conditions), true);
  const FitProblem on(model, effects, everything, 1);
  const std::vector<double> values{cosine, sine};
  return settle(on, {values, *model.residuals(effects, values, everything)}, slopes);
}

}  // namespace

TEST_CASE("a wave that stands alone settles at its size, whatever its slopes say of its phase",
          "[explain]") {
  const Amplitudes model(0);
  Eigen::MatrixXd slopes = slopes_at(model, 2, 0);
  // What differences of an evaluation leave of a slope that is nothing.
  for (Eigen::Index i = 0; i < slopes.rows(); ++i) slopes(i, 1) += i % 2 == 0 ? 0.05 : -0.02;
  const auto settled = settled_from(model, 2, 0, slopes);
  REQUIRE(settled);
  CHECK(std::hypot(settled->values[0], settled->values[1]) ==
        Approx(std::sqrt(5.0)).margin(Amplitudes::noise));
}

TEST_CASE("a small wave beside a line settles at both of its parts", "[explain]") {
  const Amplitudes model(50);
  const auto settled = settled_from(model, 0.9, -1.8, slopes_at(model, 0.9, -1.8));
  REQUIRE(settled);
  CHECK(settled->values[0] == Approx(1.0).epsilon(1e-2));
  CHECK(settled->values[1] == Approx(-2.0).epsilon(1e-2));
}

TEST_CASE("what is forecast of a wave at its bound is forecast for the values that are told",
          "[explain]") {
  const Amplitudes model(50);
  const std::vector<std::size_t> effects{0};
  const std::vector<bool> everything(static_cast<std::size_t>(Amplitudes::conditions), true);
  const FitProblem on(model, effects, everything, 1);
  const std::vector<double> values{4.9, -4.9};  // a step that keeps its phase leaves both bounds
  Evaluated from{values, *model.residuals(effects, values, everything)};
  for (Eigen::Index i = 0; i < Amplitudes::conditions; ++i) {
    from.residuals[i] = model.shown(9, -9)[i] - model.shown(4.9, -4.9)[i];
  }
  const Evaluated there = forecast(on, from, slopes_at(model, 4.9, -4.9));
  CHECK(std::abs(there.values[0]) <= Amplitudes::bound);
  CHECK(std::abs(there.values[1]) <= Amplitudes::bound);
  const Eigen::VectorXd moved =
      model.shown(there.values[0], there.values[1]) - model.shown(4.9, -4.9);
  CHECK((from.residuals - there.residuals - moved).norm() < 0.1);
}
