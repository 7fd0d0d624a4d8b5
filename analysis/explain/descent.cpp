#include "analysis/explain/descent.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/explain/settle.hpp"

namespace rvbench::analysis {
namespace {

constexpr double smallest_region =
    1e-4;  // of Levenberg and Marquardt: no step worth its evaluation
constexpr int most_tries_along_bounds = 2;
constexpr double worth_turning = 1e-5;  // a step, in scales: less shows the error of differences

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

// Takes each parameter in its own scale: Ceres tells the length of a step by all of them together,
// and a stiffness would drown a micrometre.
// Remembers where it was evaluated last, for Ceres asks for a step's cost, then for its slopes; and
// where it gave slopes last, which is where Ceres stays if nothing further on is better.
class Cost final : public ceres::CostFunction {
 public:
  Cost(const FitProblem& on, Eigen::MatrixXd held)
      : on_(on), held_(std::move(held)), rows_(trained_rows(on)), prior_(on) {
    set_num_residuals(static_cast<int>(rows_.size() + prior_.of.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(on.parameters.size()));
  }

  bool Evaluate(double const* const* blocks, double* out, double** jacobians) const override {
    std::vector<double> values = values_at(blocks[0]);
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

  std::vector<double> values_at(const double* scaled) const {
    std::vector<double> values(on_.parameters.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const ModelParameter& p = on_.parameters[i];
      values[i] = std::clamp(scaled[i] * p.scale, p.low, p.high);
    }
    return values;
  }
  const Evaluated& sloped_at() const { return sloped_at_; }
  const Eigen::MatrixXd& slopes() const { return slopes_; }

 private:
  bool give_slopes(double* out) const {
    auto slopes = jacobian(on_, here_.values, here_.residuals, held_);
    if (!slopes) return false;
    if (held_.cols() > 0 && !sloped_at_.values.empty()) turn_held(*slopes);
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> all(out, num_residuals(), slopes->cols());
    all.setZero();
    const auto measured = static_cast<Eigen::Index>(rows_.size());
    all.topRows(measured) = (*slopes)(rows_, Eigen::all);
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      all(measured + static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(prior_.of[p])) =
          1 / prior_.spread[p];
    }
    for (Eigen::Index i = 0; i < all.cols(); ++i) {
      all.col(i) *= on_.parameters[static_cast<std::size_t>(i)].scale;
    }
    slopes_ = std::move(*slopes);
    sloped_at_ = here_;
    return true;
  }

  // By what the last step showed of them: Broyden, Math. Comp. 19, 577-593 (1965).
  void turn_held(Eigen::MatrixXd& slopes) const {
    Eigen::VectorXd step(slopes.cols()), scaled(held_.cols());
    for (Eigen::Index i = 0; i < step.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      step[i] = here_.values[at] - sloped_at_.values[at];
      if (i < scaled.size()) scaled[i] = step[i] / on_.parameters[at].scale;
    }
    if (scaled.norm() < worth_turning) return;
    const Eigen::VectorXd missed =
        here_.residuals - sloped_at_.residuals - 0.5 * (slopes_ + slopes) * step;
    scaled /= scaled.squaredNorm();
    for (Eigen::Index i = 0; i < scaled.size(); ++i) {
      held_.col(i) += missed * (scaled[i] / on_.parameters[static_cast<std::size_t>(i)].scale);
    }
    slopes.leftCols(held_.cols()) = held_;
  }

  const FitProblem& on_;
  mutable Eigen::MatrixXd held_;
  std::vector<Eigen::Index> rows_;
  Prior prior_;
  mutable Evaluated here_, sloped_at_;
  mutable Eigen::MatrixXd slopes_;
};

// A model that cannot be evaluated at some values is an answer here, not news for standard error.
void keep_ceres_silent() {
  [[maybe_unused]] static const int once = FLAGS_minloglevel = google::GLOG_FATAL;
}

ceres::Solver::Options solver_options(const FitProblem& on, int iterations, double negligible) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = iterations;
  options.function_tolerance = std::max(negligible_gain(on), negligible);
  options.parameter_tolerance = 1e-6;
  options.line_search_interpolation_type = ceres::QUADRATIC;  // asks for no slopes on its way
  options.min_trust_region_radius = smallest_region;
  options.max_num_line_search_step_size_iterations = most_tries_along_bounds;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

Descent descend(const FitProblem& on, std::vector<double> values, int iterations,
                const Eigen::MatrixXd& held, double negligible) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (values.empty()) {
    auto residuals = on.model.residuals(on.effects, values, on.trained);
    if (!residuals) return {{}, infinite, false, {}, {}};
    const double cost = cost_of(on, values, *residuals);
    Eigen::MatrixXd slopes(residuals->size(), 0);
    return {{}, cost, true, std::move(*residuals), std::move(slopes)};
  }
  Cost cost(on, held);
  ceres::Problem::Options not_owner;
  not_owner.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(not_owner);
  std::vector<double> scaled(values.size());
  problem.AddResidualBlock(&cost, nullptr, scaled.data());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ModelParameter& p = on.parameters[i];
    scaled[i] = std::clamp(values[i], p.low, p.high) / p.scale;
    const auto index = static_cast<int>(i);
    if (std::isfinite(p.low)) problem.SetParameterLowerBound(scaled.data(), index, p.low / p.scale);
    if (std::isfinite(p.high)) {
      problem.SetParameterUpperBound(scaled.data(), index, p.high / p.scale);
    }
  }
  ceres::Solver::Summary summary;
  keep_ceres_silent();
  ceres::Solve(solver_options(on, iterations, negligible), &problem, &summary);
  values = cost.values_at(scaled.data());
  if (!summary.IsSolutionUsable()) return {values, infinite, false, {}, {}};
  Descent end{
      values, 2 * summary.final_cost, summary.termination_type == ceres::CONVERGENCE, {}, {}};
  if (cost.sloped_at().values == values) {
    end.residuals = cost.sloped_at().residuals;
    end.slopes = cost.slopes();
  }
  return end;
}

}  // namespace rvbench::analysis
