#include "analysis/explain/fit_problem.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/explain/wave.hpp"
#include "hal/types/linear_algebra.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr double difference_step = 1e-4;  // of a parameter's scale
constexpr double at_rest = 1e-5;          // of the cost: less is to be won by another step,
constexpr double least_scatter = 1e-6;    // of what records show: no recording is truer
constexpr double at_rest_of_one = 0.05;   // or less than this of one value's share in it

}  // namespace

Prior::Prior(const FitProblem& on) {
  for (std::size_t i = 0; i < on.parameters.size(); ++i) {
    if (!std::isfinite(on.parameters[i].spread)) continue;
    of.push_back(i);
    nominal.push_back(on.parameters[i].nominal);
    spread.push_back(on.parameters[i].spread / on.scatter);
  }
}

double Prior::cost(const std::vector<double>& values) const {
  double sum = 0;
  for (std::size_t i = 0; i < of.size(); ++i) sum += std::pow(residual(i, values), 2);
  return sum;
}

double cost_of(const FitProblem& on, const std::vector<double>& values,
               const Eigen::VectorXd& residuals) {
  double sum = Prior(on).cost(values);
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    const ObservedUnit& unit = on.model.units()[u];
    if (on.trained[u]) sum += residuals.segment(unit.first, unit.size).squaredNorm();
  }
  return sum;
}

double values_learned(const FitProblem& on) {
  double values = 0;
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    if (on.trained[u]) values += static_cast<double>(on.model.units()[u].size);
  }
  return values;
}

double negligible_gain(const FitProblem& on) {
  return std::max(at_rest, at_rest_of_one / std::max(values_learned(on), 1.0));
}

FitProblem::FitProblem(const ForwardModel& fitted, const std::vector<std::size_t>& with,
                       const std::vector<bool>& learned_from, double residual_scatter)
    : model(fitted),
      effects(with),
      trained(learned_from),
      scatter(residual_scatter),
      parameters(parameters_of(fitted, with)) {}

double mean_square_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                      const std::vector<bool>& trained) {
  double squares = 0, count = 0;
  for (std::size_t u = 0; u < trained.size(); ++u) {
    const ObservedUnit& unit = model.units()[u];
    if (!trained[u]) continue;
    squares += residuals.segment(unit.first, unit.size).squaredNorm();
    count += static_cast<double>(unit.size);
  }
  return count > 0 ? squares / count : 0;
}

double scatter_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                  const std::vector<bool>& trained) {
  const double rms = std::sqrt(mean_square_of(model, residuals, trained));
  return std::max(model.counts_standard_errors() ? 1.0 : least_scatter, rms);
}

std::vector<ModelParameter> parameters_of(const ForwardModel& model,
                                          const std::vector<std::size_t>& effects) {
  std::vector<ModelParameter> all = model.base();
  for (const std::size_t effect : effects) {
    const auto& more = model.library().at(effect).parameters;
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

Eigen::MatrixXd information_of(const FitProblem& on, const Eigen::MatrixXd& slopes) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    if (!on.trained[u]) continue;
    const auto j = slopes.middleRows(on.model.units()[u].first, on.model.units()[u].size);
    information += algebra::gram(j);
  }
  const Prior prior(on);
  for (std::size_t p = 0; p < prior.of.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(prior.of[p]);
    information(i, i) += 1 / (prior.spread[p] * prior.spread[p]);
  }
  return information;
}

namespace {

std::vector<double> difference_steps(const FitProblem& on, const std::vector<double>& values) {
  std::vector<double> steps;
  for (const ModelParameter& p : on.parameters) steps.push_back(difference_step * p.scale);
  for (const std::size_t at : waves_among(on.model, on.effects)) {
    const double size = std::hypot(values[at], values[at + 1]);
    for (const std::size_t i : {at, at + 1}) steps[i] = step_of_wave(steps[i], size);
  }
  return steps;
}

}  // namespace

std::optional<Eigen::MatrixXd> jacobian(const FitProblem& on, const std::vector<double>& values,
                                        const Eigen::VectorXd& residuals,
                                        const Eigen::MatrixXd& held) {
  Eigen::MatrixXd slopes(residuals.size(), static_cast<Eigen::Index>(values.size()));
  if (held.cols() > 0) slopes.leftCols(held.cols()) = held;
  const auto first = static_cast<std::size_t>(held.cols());
  const std::vector<double> steps = difference_steps(on, values);
  std::vector<char> known(values.size() - first, 0);
  parallel_for(known.size(), [&](std::size_t column) {
    const std::size_t i = first + column;
    std::vector<double> moved = values;
    double step = steps[i];
    if (values[i] + step > on.parameters[i].high) step = -step;
    moved[i] += step;
    const auto there = on.model.residuals(on.effects, moved, on.trained);
    if (!there || !there->allFinite()) return;
    slopes.col(static_cast<Eigen::Index>(i)) = (*there - residuals) / step;
    known[column] = 1;
  });
  if (std::ranges::find(known, 0) != known.end()) return std::nullopt;
  return slopes;
}

}  // namespace rvbench::analysis
