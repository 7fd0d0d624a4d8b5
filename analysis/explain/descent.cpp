#include "analysis/explain/descent.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr double difference_step = 1e-4;  // of a parameter's scale
constexpr double at_rest = 1e-5;          // of the cost: less is to be won by another step,
constexpr double at_rest_of_one = 0.02;   // or less than this of one value's share in it
constexpr double smallest_region =
    1e-4;  // of Levenberg and Marquardt: no step worth its evaluation
constexpr int most_tries_along_bounds = 4;
constexpr int iterations_of_a_stand_in = 2;  // that one more of them is worth
constexpr int most_iterations_of_a_stand_in = 20;
constexpr int most_halvings = 3;    // of a step that a stand-in was wrong about
constexpr int most_steps = 3;       // with the slopes of another fit
constexpr double no_slope = 1e-10;  // of the largest one, squared

// The rows of the units that are learned from.
std::vector<Eigen::Index> trained_rows(const FitProblem& on) {
  std::vector<Eigen::Index> rows;
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    if (!on.trained[u]) continue;
    const ObservedUnit& unit = on.model.units()[u];
    for (Eigen::Index i = 0; i < unit.size; ++i) rows.push_back(unit.first + i);
  }
  return rows;
}

// What is known of the parameters beforehand, as further residuals: (value − nominal) / spread,
// times the scatter of the others.
struct Prior {
  std::vector<std::size_t> of;
  std::vector<double> nominal, spread;

  explicit Prior(const FitProblem& on) {
    for (std::size_t i = 0; i < on.parameters.size(); ++i) {
      if (!std::isfinite(on.parameters[i].spread)) continue;
      of.push_back(i);
      nominal.push_back(on.parameters[i].nominal);
      spread.push_back(on.parameters[i].spread / on.scatter);
    }
  }
  double residual(std::size_t i, const std::vector<double>& values) const {
    return (values[of[i]] - nominal[i]) / spread[i];
  }
  double cost(const std::vector<double>& values) const {
    double sum = 0;
    for (std::size_t i = 0; i < of.size(); ++i) sum += std::pow(residual(i, values), 2);
    return sum;
  }
};

// Remembers where it was evaluated last, for Ceres asks for a step's cost, then for its slopes; and
// where it gave slopes last, which is where Ceres stays if nothing further on is better.
class Cost final : public ceres::CostFunction {
 public:
  Cost(const FitProblem& on, const Eigen::MatrixXd& held)
      : on_(on), held_(held), rows_(trained_rows(on)), prior_(on) {
    set_num_residuals(static_cast<int>(rows_.size() + prior_.of.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(on.parameters.size()));
  }

  bool Evaluate(double const* const* blocks, double* out, double** jacobians) const override {
    std::vector<double> values(blocks[0], blocks[0] + on_.parameters.size());
    if (values != here_.values) {
      auto residuals = on_.model.residuals(on_.effects, values, on_.trained);
      if (!residuals || !residuals->allFinite()) return false;
      here_ = {std::move(values), std::move(*residuals)};
    }
    const auto measured = static_cast<Eigen::Index>(rows_.size());
    Eigen::Map<Eigen::VectorXd> residuals(out, num_residuals());
    residuals.head(measured) = here_.residuals(rows_);
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      residuals[measured + static_cast<Eigen::Index>(p)] = prior_.residual(p, here_.values);
    }
    return jacobians == nullptr || jacobians[0] == nullptr || give_slopes(jacobians[0]);
  }

  const Evaluated& sloped_at() const { return sloped_at_; }
  const Eigen::MatrixXd& slopes() const { return slopes_; }

 private:
  bool give_slopes(double* out) const {
    auto slopes = jacobian(on_, here_.values, here_.residuals, held_);
    if (!slopes) return false;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> all(out, num_residuals(), slopes->cols());
    all.setZero();
    const auto measured = static_cast<Eigen::Index>(rows_.size());
    all.topRows(measured) = (*slopes)(rows_, Eigen::all);
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      all(measured + static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(prior_.of[p])) =
          1 / prior_.spread[p];
    }
    slopes_ = std::move(*slopes);
    sloped_at_ = here_;
    return true;
  }

  const FitProblem& on_;
  const Eigen::MatrixXd& held_;
  std::vector<Eigen::Index> rows_;
  Prior prior_;
  mutable Evaluated here_, sloped_at_;
  mutable Eigen::MatrixXd slopes_;
};

// A model that cannot be evaluated at some values is an answer here, not news for standard error.
void keep_ceres_silent() {
  [[maybe_unused]] static const int once = FLAGS_minloglevel = google::GLOG_FATAL;
}

// Share of the cost that is not worth another step.
double negligible_gain(const FitProblem& on) {
  double values = 0;
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    if (on.trained[u]) values += static_cast<double>(on.model.units()[u].size);
  }
  return std::max(at_rest, at_rest_of_one / std::max(values, 1.0));
}

ceres::Solver::Options solver_options(const FitProblem& on, int iterations) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = iterations;
  options.function_tolerance = negligible_gain(on);
  options.parameter_tolerance = 1e-6;
  options.line_search_interpolation_type = ceres::QUADRATIC;  // asks for no slopes on its way
  options.min_trust_region_radius = smallest_region;
  options.max_num_line_search_step_size_iterations = most_tries_along_bounds;
  options.logging_type = ceres::SILENT;
  return options;
}

double trained_cost(const FitProblem& on, const Eigen::VectorXd& residuals) {
  double sum = 0;
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    const ObservedUnit& unit = on.model.units()[u];
    if (on.trained[u]) sum += residuals.segment(unit.first, unit.size).squaredNorm();
  }
  return sum;
}

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

Descent descend_directly(const FitProblem& on, std::vector<double> values, int iterations,
                         const Eigen::MatrixXd& held) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (values.empty()) {
    auto residuals = on.model.residuals(on.effects, values, on.trained);
    if (!residuals) return {{}, infinite, false, {}, {}, {}};
    const double cost = trained_cost(on, *residuals);
    Eigen::MatrixXd slopes(residuals->size(), 0);
    return {{}, cost, true, std::move(*residuals), std::move(slopes), {}};
  }
  Cost cost(on, held);
  ceres::Problem::Options not_owner;
  not_owner.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(not_owner);
  problem.AddResidualBlock(&cost, nullptr, values.data());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ModelParameter& p = on.parameters[i];
    values[i] = std::clamp(values[i], p.low, p.high);
    const auto index = static_cast<int>(i);
    if (std::isfinite(p.low)) problem.SetParameterLowerBound(values.data(), index, p.low);
    if (std::isfinite(p.high)) problem.SetParameterUpperBound(values.data(), index, p.high);
  }
  ceres::Solver::Summary summary;
  keep_ceres_silent();
  ceres::Solve(solver_options(on, iterations), &problem, &summary);
  if (!summary.IsSolutionUsable()) return {values, infinite, false, {}, {}, {}};
  Descent end{
      values, 2 * summary.final_cost, summary.termination_type == ceres::CONVERGENCE, {}, {}, {}};
  if (cost.sloped_at().values == values) {
    end.residuals = cost.sloped_at().residuals;
    end.slopes = cost.slopes();
  }
  return end;
}

// Where a model's stand-in at these values begins.
std::optional<Descent> stood_in(const FitProblem& on, const std::vector<double>& values,
                                const ForwardModel* like) {
  std::shared_ptr<const ForwardModel> stand_in = on.model.straightened(on.effects, values, like);
  if (!stand_in) return std::nullopt;
  auto residuals = stand_in->residuals(on.effects, values, on.trained);
  if (!residuals || !residuals->allFinite()) return std::nullopt;
  const double cost = trained_cost(on, *residuals) + Prior(on).cost(values);
  return Descent{values, cost, false, *std::move(residuals), {}, std::move(stand_in)};
}

// To where the stand-in would come to rest, or part of the way if it is not that good there.
// @return nothing if no better place is found
std::optional<Descent> step_by_stand_in(const FitProblem& on, const Descent& at,
                                        const ForwardModel* like) {
  const FitProblem near(*at.stand_in, on.effects, on.trained, on.scatter);
  const Descent foreseen = descend_directly(near, at.values, most_iterations_of_a_stand_in, {});
  const double least_gain = negligible_gain(on) * at.cost;
  if (at.cost - foreseen.cost < least_gain) return std::nullopt;
  std::vector<double> to = foreseen.values;
  for (int halved = 0; halved < most_halvings; ++halved) {
    const auto residuals = on.model.residuals(on.effects, to, on.trained);
    const double cost = residuals && residuals->allFinite()
                            ? trained_cost(on, *residuals) + Prior(on).cost(to)
                            : std::numeric_limits<double>::infinity();
    if (cost < at.cost - least_gain) return stood_in(on, to, like);
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = 0.5 * (to[i] + at.values[i]);
  }
  return std::nullopt;
}

}  // namespace

FitProblem::FitProblem(const ForwardModel& fitted, const std::vector<std::size_t>& with,
                       const std::vector<bool>& learned_from, double residual_scatter)
    : model(fitted),
      effects(with),
      trained(learned_from),
      scatter(residual_scatter),
      parameters(parameters_of(fitted, with)) {}

double scatter_of(const ForwardModel& model, const Eigen::VectorXd& residuals,
                  const std::vector<bool>& trained) {
  double squares = 0, count = 0;
  for (std::size_t u = 0; u < trained.size(); ++u) {
    const ObservedUnit& unit = model.units()[u];
    if (!trained[u]) continue;
    squares += residuals.segment(unit.first, unit.size).squaredNorm();
    count += static_cast<double>(unit.size);
  }
  return count > 0 ? std::max(1.0, std::sqrt(squares / count)) : 1.0;
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
    information.noalias() += j.transpose() * j;
  }
  const Prior prior(on);
  for (std::size_t p = 0; p < prior.of.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(prior.of[p]);
    information(i, i) += 1 / (prior.spread[p] * prior.spread[p]);
  }
  return information;
}

std::optional<Eigen::MatrixXd> jacobian(const FitProblem& on, const std::vector<double>& values,
                                        const Eigen::VectorXd& residuals,
                                        const Eigen::MatrixXd& held) {
  Eigen::MatrixXd slopes(residuals.size(), static_cast<Eigen::Index>(values.size()));
  if (held.cols() > 0) slopes.leftCols(held.cols()) = held;
  const auto first = static_cast<std::size_t>(held.cols());
  std::vector<char> known(values.size() - first, 0);
  parallel_for(known.size(), [&](std::size_t column) {
    const std::size_t i = first + column;
    std::vector<double> moved = values;
    double step = difference_step * on.parameters[i].scale;
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

Descent descend(const FitProblem& on, std::vector<double> values, int iterations,
                const KnownSlopes& known) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::clamp(values[i], on.parameters[i].low, on.parameters[i].high);
  }
  auto start = stood_in(on, values, known.stand_in.get());
  if (!start) return descend_directly(on, std::move(values), iterations, known.held);
  Descent at = *std::move(start);
  const int rounds = std::max(1, iterations / iterations_of_a_stand_in);
  for (int round = 0; round < rounds && !at.converged; ++round) {
    auto next = step_by_stand_in(on, at, known.stand_in.get());
    if (next) at = *std::move(next);
    at.converged = !next || at.converged;
  }
  const FitProblem there(*at.stand_in, on.effects, on.trained, on.scatter);
  if (auto slopes = jacobian(there, at.values, at.residuals)) {
    at.slopes = *std::move(slopes);
  } else {
    at.residuals.resize(0);
  }
  return at;
}

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
  double cost = trained_cost(on, at.residuals) + prior.cost(at.values);
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
    const double before =
        std::exchange(cost, trained_cost(on, at.residuals) + prior.cost(at.values));
    if (cost > before * (1 + least_gain)) break;
  }
  return std::nullopt;
}

}  // namespace rvbench::analysis
