#include "analysis/explain/fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>

namespace rvbench::analysis {
namespace {

constexpr double difference_step = 1e-4;  // of a parameter's scale
constexpr int most_iterations = 30;       // of a fit, after the opening
constexpr int most_refit_iterations = 8;  // from where a fit on nearly the same data ended
constexpr double same_cost = 1e-4;
constexpr double same_value = 0.05;
constexpr double same_in_errors = 0.1;     // of a standard error
constexpr int opening_iterations = 2;      // of each start
constexpr int middle_iterations = 4;       // of those that go on after that
constexpr std::size_t most_finalists = 3;  // starts that go on after that

// The rows of the units that are learned from.
std::vector<Eigen::Index> trained_rows(const ForwardModel& model,
                                       const std::vector<bool>& trained) {
  std::vector<Eigen::Index> rows;
  for (std::size_t u = 0; u < model.units().size(); ++u) {
    if (!trained[u]) continue;
    const ObservedUnit& unit = model.units()[u];
    for (Eigen::Index i = 0; i < unit.size; ++i) rows.push_back(unit.first + i);
  }
  return rows;
}

// What is known of the parameters beforehand, as further residuals: (value − nominal) / spread.
struct Prior {
  std::vector<std::size_t> of;
  std::vector<double> nominal, spread;

  explicit Prior(const std::vector<ModelParameter>& parameters) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!std::isfinite(parameters[i].spread)) continue;
      of.push_back(i);
      nominal.push_back(parameters[i].nominal);
      spread.push_back(parameters[i].spread);
    }
  }
};

class Cost final : public ceres::CostFunction {
 public:
  Cost(const ForwardModel& model, const std::vector<std::size_t>& effects,
       const std::vector<bool>& trained, const std::vector<ModelParameter>& parameters)
      : model_(model),
        effects_(effects),
        trained_(trained),
        count_(parameters.size()),
        rows_(trained_rows(model, trained)),
        prior_(parameters) {
    set_num_residuals(static_cast<int>(rows_.size() + prior_.of.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(count_));
  }

  bool Evaluate(double const* const* blocks, double* out, double** jacobians) const override {
    const std::vector<double> values(blocks[0], blocks[0] + count_);
    const auto here = model_.residuals(effects_, values, trained_);
    if (!here || !here->allFinite()) return false;
    const auto measured = static_cast<Eigen::Index>(rows_.size());
    Eigen::Map<Eigen::VectorXd> residuals(out, num_residuals());
    residuals.head(measured) = (*here)(rows_);
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      residuals[measured + static_cast<Eigen::Index>(p)] =
          (values[prior_.of[p]] - prior_.nominal[p]) / prior_.spread[p];
    }
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const auto slopes = jacobian(model_, effects_, values, *here, trained_);
    if (!slopes) return false;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> all(jacobians[0], num_residuals(), static_cast<Eigen::Index>(count_));
    all.setZero();
    all.topRows(measured) = (*slopes)(rows_, Eigen::all);
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      all(measured + static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(prior_.of[p])) =
          1 / prior_.spread[p];
    }
    return true;
  }

 private:
  const ForwardModel& model_;
  const std::vector<std::size_t>& effects_;
  const std::vector<bool>& trained_;
  std::size_t count_;
  std::vector<Eigen::Index> rows_;
  Prior prior_;
};

struct Descent {
  std::vector<double> values;
  double cost = 0;
  bool converged = false;
};

// A model that cannot be evaluated at some values is an answer here, not news for standard error.
void keep_ceres_silent() {
  [[maybe_unused]] static const int once = FLAGS_minloglevel = google::GLOG_FATAL;
}

Descent descend(const ForwardModel& model, const std::vector<std::size_t>& effects,
                const std::vector<ModelParameter>& parameters, std::vector<double> values,
                const std::vector<bool>& trained, int iterations) {
  if (parameters.empty()) {
    const auto residuals = model.residuals(effects, values, trained);
    if (!residuals) return {values, std::numeric_limits<double>::infinity(), false};
    return {values, (*residuals)(trained_rows(model, trained)).squaredNorm(), true};
  }
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(model, effects, trained, parameters), nullptr, values.data());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    values[i] = std::clamp(values[i], parameters[i].low, parameters[i].high);
    const auto index = static_cast<int>(i);
    if (std::isfinite(parameters[i].low)) {
      problem.SetParameterLowerBound(values.data(), index, parameters[i].low);
    }
    if (std::isfinite(parameters[i].high)) {
      problem.SetParameterUpperBound(values.data(), index, parameters[i].high);
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = 0.1 * same_cost;
  options.parameter_tolerance = 1e-6;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  keep_ceres_silent();
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) {
    return {values, std::numeric_limits<double>::infinity(), false};
  }
  return {values, 2 * summary.final_cost, summary.termination_type == ceres::CONVERGENCE};
}

// (JᵀJ)⁻¹ (Σ_u g_u g_uᵀ) (JᵀJ)⁻¹ over the units learned from.
Eigen::MatrixXd clustered_covariance(const ForwardModel& model, const Eigen::MatrixXd& slopes,
                                     const Eigen::VectorXd& residuals,
                                     const std::vector<ModelParameter>& parameters,
                                     const std::vector<bool>& trained) {
  const Eigen::Index n = slopes.cols();
  if (n == 0) return {};
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(n, n);
  double units = 0;
  for (std::size_t u = 0; u < model.units().size(); ++u) {
    if (!trained[u]) continue;
    const ObservedUnit& unit = model.units()[u];
    const auto j = slopes.middleRows(unit.first, unit.size);
    const Eigen::VectorXd gradient = j.transpose() * residuals.segment(unit.first, unit.size);
    information += j.transpose() * j;
    scatter += gradient * gradient.transpose();
    ++units;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const double spread = parameters[static_cast<std::size_t>(i)].spread;
    if (!std::isfinite(spread)) continue;
    information(i, i) += 1 / (spread * spread);
    scatter(i, i) += 1 / (spread * spread);
  }
  const Eigen::MatrixXd inverse = information.completeOrthogonalDecomposition().pseudoInverse();
  return units / std::max(units - static_cast<double>(n), 1.0) * inverse * scatter * inverse;
}

std::string disagreement(const Descent& best, const Descent& other,
                         const std::vector<ModelParameter>& parameters,
                         const Eigen::MatrixXd& covariance) {
  if (other.cost > best.cost * (1 + same_cost)) {
    return fmt::format("starts end at costs of {:.6g} and {:.6g}", best.cost, other.cost);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto index = static_cast<Eigen::Index>(i);
    const double apart = std::abs(best.values[i] - other.values[i]);
    const double error = std::sqrt(std::max(covariance(index, index), 0.0));
    if (apart > same_value * std::abs(best.values[i]) && apart > same_in_errors * error) {
      return fmt::format("starts end at {} = {:.4g} and {:.4g} {}", parameters[i].name,
                         best.values[i], other.values[i], parameters[i].unit);
    }
  }
  return {};
}

// Whether the first two came to rest in the same place.
bool settled(const std::vector<Descent>& ends, const std::vector<ModelParameter>& parameters) {
  if (ends.size() < 2 || !ends[0].converged || !ends[1].converged) return false;
  if (std::abs(ends[1].cost - ends[0].cost) > ends[0].cost * same_cost) return false;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double apart = std::abs(ends[0].values[i] - ends[1].values[i]);
    if (apart > same_value * std::abs(ends[0].values[i])) return false;
  }
  return true;
}

std::string certificate(const std::vector<Descent>& ends,
                        const std::vector<ModelParameter>& parameters,
                        const Eigen::MatrixXd& covariance) {
  if (!ends.front().converged) return "the fit did not converge";
  std::string why = "there is only one start";
  for (std::size_t i = 1; i < ends.size(); ++i) {
    why = disagreement(ends.front(), ends[i], parameters, covariance);
    if (why.empty()) break;
  }
  return why;
}

}  // namespace

std::vector<ModelParameter> parameters_of(const ForwardModel& model,
                                          const std::vector<std::size_t>& effects) {
  std::vector<ModelParameter> all = model.base();
  for (const std::size_t effect : effects) {
    const auto& more = model.library().at(effect).parameters;
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

std::size_t first_value_of(const ForwardModel& model, const std::vector<std::size_t>& effects,
                           std::size_t place) {
  std::size_t at = model.base().size();
  for (std::size_t i = 0; i < place; ++i) at += model.library()[effects[i]].parameters.size();
  return at;
}

std::optional<Eigen::MatrixXd> jacobian(const ForwardModel& model,
                                        const std::vector<std::size_t>& effects,
                                        const std::vector<double>& values,
                                        const Eigen::VectorXd& residuals,
                                        const std::vector<bool>& trained) {
  const std::vector<ModelParameter> parameters = parameters_of(model, effects);
  Eigen::MatrixXd slopes(residuals.size(), static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<double> moved = values;
    double step = difference_step * parameters[i].scale;
    if (values[i] + step > parameters[i].high) step = -step;
    moved[i] += step;
    const auto there = model.residuals(effects, moved, trained);
    if (!there || !there->allFinite()) return std::nullopt;
    slopes.col(static_cast<Eigen::Index>(i)) = (*there - residuals) / step;
  }
  return slopes;
}

Fit fit_from(const ForwardModel& model, const std::vector<std::size_t>& effects,
             const std::vector<std::vector<double>>& starts, const std::vector<bool>& trained,
             const MustBeat& must_beat) {
  const std::vector<ModelParameter> parameters = parameters_of(model, effects);
  std::vector<Descent> ends;
  for (const std::vector<double>& start : starts) {
    ends.push_back(descend(model, effects, parameters, start, trained, opening_iterations));
  }
  std::ranges::sort(ends, {}, &Descent::cost);
  if (ends.size() > most_finalists) ends.resize(most_finalists);
  for (Descent& end : ends) {
    if (end.converged) continue;
    end = descend(model, effects, parameters, end.values, trained, middle_iterations);
  }
  std::ranges::sort(ends, {}, &Descent::cost);
  const auto given_up = [&] {
    const Descent& best = std::ranges::min(ends, {}, &Descent::cost);
    return Fit{effects, best.values, {}, {}, best.cost, "explains too little"};
  };
  if (ends.front().cost > must_beat.after_first_moves) return given_up();
  for (std::size_t i = 0; i < ends.size() && !settled(ends, parameters); ++i) {
    if (ends[i].converged) continue;
    ends[i] = descend(model, effects, parameters, ends[i].values, trained, most_iterations);
    if (!ends[i].converged) break;
    if (std::ranges::min(ends, {}, &Descent::cost).cost > must_beat.at_rest) return given_up();
  }
  std::ranges::sort(ends, {}, &Descent::cost);
  Fit fit{effects, ends.front().values, {}, {}, ends.front().cost, {}};
  const auto residuals = model.residuals(effects, fit.values, trained);
  const auto slopes =
      residuals ? jacobian(model, effects, fit.values, *residuals, trained) : std::nullopt;
  if (!slopes) {
    fit.not_certified = "the model cannot be evaluated where the fit ended";
    return fit;
  }
  fit.residuals = *residuals;
  fit.covariance = clustered_covariance(model, *slopes, *residuals, parameters, trained);
  fit.not_certified = certificate(ends, parameters, fit.covariance);
  return fit;
}

Fit fit_with(const ForwardModel& model, const Fit& before, std::size_t added,
             const std::vector<bool>& trained, const MustBeat& must_beat) {
  std::vector<std::size_t> effects = before.effects;
  effects.push_back(added);
  std::vector<std::vector<double>> starts;
  for (const std::vector<double>& own : model.library().at(added).starts) {
    starts.push_back(before.values);
    starts.back().insert(starts.back().end(), own.begin(), own.end());
  }
  return fit_from(model, effects, starts, trained, must_beat);
}

Refit refit_from(const ForwardModel& model, const std::vector<std::size_t>& effects,
                 const std::vector<double>& start, const std::vector<bool>& trained) {
  const Descent end =
      descend(model, effects, parameters_of(model, effects), start, trained, most_refit_iterations);
  auto residuals = model.residuals(effects, end.values, trained);
  return {end.values, residuals ? std::move(*residuals) : Eigen::VectorXd()};
}

}  // namespace rvbench::analysis
