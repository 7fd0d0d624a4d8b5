#include "analysis/explain/settle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "analysis/explain/wave.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

constexpr int most_steps = 4;       // with the slopes of another fit
constexpr double no_slope = 1e-10;  // of the largest one, squared

// Half the slope of the cost.
Eigen::VectorXd gradient_at(const FitProblem& on, const Prior& prior, const Evaluated& at,
                            const Eigen::MatrixXd& slopes) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(slopes.cols());
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    if (!on.trained[u]) continue;
    const ObservedUnit& unit = on.model.units()[u];
    gradient.noalias() += slopes.middleRows(unit.first, unit.size).transpose() *
                          at.residuals.segment(unit.first, unit.size);
  }
  for (std::size_t p = 0; p < prior.of.size(); ++p) {
    gradient[static_cast<Eigen::Index>(prior.of[p])] +=
        prior.residual(p, at.values) / prior.spread[p];
  }
  return gradient;
}

// The lowest point of the quadratic within bounds: what would leave them ends there.
Eigen::VectorXd step_within_bounds(const std::vector<ModelParameter>& parameters,
                                   const std::vector<double>& values,
                                   const Eigen::MatrixXd& information,
                                   const Eigen::VectorXd& gradient) {
  std::vector<Eigen::Index> open(values.size());
  std::iota(open.begin(), open.end(), 0);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(gradient.size());
  Eigen::VectorXd scale = information.diagonal().cwiseSqrt();
  scale = (scale.array() > 0).select(scale.cwiseInverse(), 1.0);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  while (!open.empty()) {
    const Eigen::VectorXd pull = -(gradient + information * step).cwiseProduct(scale);
    const Eigen::VectorXd more = algebra::MinimumNorm(scaled(open, open), no_slope)
                                     .solve(pull(open))
                                     .cwiseProduct(scale(open));
    std::vector<Eigen::Index> within;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const auto i = static_cast<std::size_t>(open[k]);
      const double to = values[i] + more[static_cast<Eigen::Index>(k)];
      const double bounded = std::clamp(to, parameters[i].low, parameters[i].high);
      if (bounded == to) {
        within.push_back(open[k]);
      } else {
        step[open[k]] = bounded - values[i];
      }
    }
    if (within.size() == open.size()) {
      step(open) = more;
      break;
    }
    open = std::move(within);
  }
  return step;
}

// Goes by the same slopes from place to place: waves that turn as size and phase.
class Steps {
 public:
  Steps(const FitProblem& on, const Evaluated& from, const Eigen::MatrixXd& slopes)
      : on_(on),
        prior_(on),
        waves_(waves_that_turn(slopes, from.values, waves_among(on.model, on.effects))),
        slopes_(slopes_of_waves(slopes, from.values, waves_)),
        information_(information_of(on, slopes_)),
        bounds_(on.parameters) {
    for (const std::size_t at : waves_) bound_wave(at);
  }

  struct Step {
    std::vector<double> to;
    double gain;                // of the cost, if the model is as straight as the slopes
    Eigen::VectorXd residuals;  // by how much they change then
  };
  Step from(const Evaluated& at) const {
    std::vector<double> values = as_waves(at.values, waves_);
    const Eigen::VectorXd gradient = gradient_at(on_, prior_, at, slopes_);
    const Eigen::VectorXd step = step_within_bounds(bounds_, values, information_, gradient);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += step[static_cast<Eigen::Index>(i)];
    values = from_waves(std::move(values), waves_);
    return {std::move(values), -(2 * gradient + information_ * step).dot(step), slopes_ * step};
  }

 private:
  // So that whatever its phase, neither part leaves its own bounds.
  void bound_wave(std::size_t at) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    ModelParameter &size = bounds_[at], &phase = bounds_[at + 1];
    size.high = std::min({-size.low, size.high, -phase.low, phase.high});
    size.low = -size.high;
    phase.low = -infinite;
    phase.high = infinite;
  }

  const FitProblem& on_;
  Prior prior_;
  std::vector<std::size_t> waves_;  // their parts have no spread
  Eigen::MatrixXd slopes_, information_;
  std::vector<ModelParameter> bounds_;
};

}  // namespace

Evaluated forecast(const FitProblem& on, const Evaluated& from, const Eigen::MatrixXd& slopes) {
  Steps::Step step = Steps(on, from, slopes).from(from);
  return {std::move(step.to), from.residuals + step.residuals};
}

std::optional<Evaluated> settle(const FitProblem& on, const Evaluated& from,
                                const Eigen::MatrixXd& slopes) {
  const Steps steps(on, from, slopes);
  const double least_gain = negligible_gain(on);
  Evaluated at = from;
  double cost = cost_of(on, at.values, at.residuals);
  for (int made = 0; made < most_steps; ++made) {
    Steps::Step step = steps.from(at);
    if (made > 0 && step.gain < least_gain * cost) return at;
    auto residuals = on.model.residuals(on.effects, step.to, on.trained);
    if (!residuals || !residuals->allFinite()) break;
    at = {std::move(step.to), std::move(*residuals)};
    const double before = std::exchange(cost, cost_of(on, at.values, at.residuals));
    if (cost > before * (1 + least_gain)) break;
    // Slopes of what leaves no trace are all error, and promise what no step will bring.
    if (cost > before * (1 - least_gain)) return at;
  }
  return std::nullopt;
}

}  // namespace rvbench::analysis
