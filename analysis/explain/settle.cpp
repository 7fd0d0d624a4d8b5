#include "analysis/explain/settle.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rvbench::analysis {
namespace {

constexpr int most_steps = 3;       // with the slopes of another fit
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
Eigen::VectorXd step_within_bounds(const FitProblem& on, const std::vector<double>& values,
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
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(no_slope);
    solver.compute(scaled(open, open));
    const Eigen::VectorXd more = solver.solve(pull(open)).cwiseProduct(scale(open));
    std::vector<Eigen::Index> within;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const auto i = static_cast<std::size_t>(open[k]);
      const double to = values[i] + more[static_cast<Eigen::Index>(k)];
      const double bounded = std::clamp(to, on.parameters[i].low, on.parameters[i].high);
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

}  // namespace

Evaluated forecast(const FitProblem& on, const Evaluated& from, const Eigen::MatrixXd& slopes) {
  const Prior prior(on);
  const Eigen::VectorXd step = step_within_bounds(on, from.values, information_of(on, slopes),
                                                  gradient_at(on, prior, from, slopes));
  Evaluated there{from.values, from.residuals + slopes * step};
  for (std::size_t i = 0; i < there.values.size(); ++i) {
    there.values[i] += step[static_cast<Eigen::Index>(i)];
  }
  return there;
}

std::optional<Evaluated> settle(const FitProblem& on, const Evaluated& from,
                                const Eigen::MatrixXd& slopes) {
  const Prior prior(on);
  const Eigen::MatrixXd information = information_of(on, slopes);
  const double least_gain = negligible_gain(on);
  Evaluated at = from;
  double cost = cost_of(on, at.values, at.residuals);
  for (int steps = 0; steps <= most_steps; ++steps) {
    const Eigen::VectorXd gradient = gradient_at(on, prior, at, slopes);
    const Eigen::VectorXd step = step_within_bounds(on, at.values, information, gradient);
    const double gain = -(2 * gradient + information * step).dot(step);
    if (steps > 0 && gain < least_gain * cost) return at;
    for (std::size_t i = 0; i < at.values.size(); ++i) {
      at.values[i] = std::clamp(at.values[i] + step[static_cast<Eigen::Index>(i)],
                                on.parameters[i].low, on.parameters[i].high);
    }
    auto residuals = on.model.residuals(on.effects, at.values, on.trained);
    if (!residuals || !residuals->allFinite()) break;
    at.residuals = std::move(*residuals);
    const double before = std::exchange(cost, cost_of(on, at.values, at.residuals));
    if (cost > before * (1 + least_gain)) break;
  }
  return std::nullopt;
}

}  // namespace rvbench::analysis
