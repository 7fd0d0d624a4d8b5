#include "analysis/explain/fit.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr int most_iterations = 30;       // of a fit, after the first moves
constexpr int most_refit_iterations = 8;  // from where a fit on nearly the same data ended
constexpr double same_cost = 1e-4;
constexpr double same_value = 0.05;
constexpr double same_in_errors = 0.1;     // of a standard error
constexpr int opening_iterations = 2;      // of each start
constexpr int middle_iterations = 4;       // of those that go on after that
constexpr std::size_t most_finalists = 3;  // starts that go on after that

// (JᵀJ)⁻¹ (Σ_u g_u g_uᵀ) (JᵀJ)⁻¹ over the units learned from.
Eigen::MatrixXd clustered_covariance(const FitProblem& on, const Eigen::MatrixXd& slopes,
                                     const Eigen::VectorXd& residuals) {
  const Eigen::Index n = slopes.cols();
  if (n == 0) return {};
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(n, n);
  double units = 0;
  for (std::size_t u = 0; u < on.trained.size(); ++u) {
    if (!on.trained[u]) continue;
    const ObservedUnit& unit = on.model.units()[u];
    const auto j = slopes.middleRows(unit.first, unit.size);
    const Eigen::VectorXd gradient = j.transpose() * residuals.segment(unit.first, unit.size);
    scatter += gradient * gradient.transpose();
    ++units;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const double spread = on.parameters[static_cast<std::size_t>(i)].spread;
    if (std::isfinite(spread)) scatter(i, i) += 1 / (spread * spread);
  }
  const Eigen::MatrixXd inverse =
      information_of(on, slopes).completeOrthogonalDecomposition().pseudoInverse();
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

// Whether two came to rest in the same place.
bool same_place(const Descent& a, const Descent& b) {
  if (!a.converged || !b.converged || std::abs(a.cost - b.cost) > a.cost * same_cost) return false;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (std::abs(a.values[i] - b.values[i]) > same_value * std::abs(a.values[i])) return false;
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

// The best after all starts have made a few moves, in order of their costs.
std::vector<Descent> first_moves(const FitProblem& on,
                                 const std::vector<std::vector<double>>& starts,
                                 const Eigen::MatrixXd& held) {
  std::vector<Descent> ends;
  for (const std::vector<double>& start : starts) {
    ends.push_back(descend(on, start, opening_iterations, held));
  }
  std::ranges::stable_sort(ends, {}, &Descent::cost);
  if (ends.size() > most_finalists) ends.resize(most_finalists);
  for (Descent& end : ends) {
    if (!end.converged) end = descend(on, end.values, middle_iterations, held);
  }
  std::ranges::stable_sort(ends, {}, &Descent::cost);
  return ends;
}

// The others go where the first one did, in its own steps, unless they come to rest elsewhere.
void certify(const FitProblem& on, std::vector<Descent>& ends) {
  for (std::size_t i = 1; i < ends.size(); ++i) {
    Descent& end = ends[i];
    end = descend(on, end.values, most_refit_iterations, ends.front().slopes);
    if (!same_place(ends.front(), end)) end = descend(on, end.values, most_iterations);
    if (!end.converged || same_place(ends.front(), end)) break;
  }
  std::ranges::stable_sort(ends, {}, &Descent::cost);
}

}  // namespace

std::size_t first_value_of(const ForwardModel& model, const std::vector<std::size_t>& effects,
                           std::size_t place) {
  std::size_t at = model.base().size();
  for (std::size_t i = 0; i < place; ++i) at += model.library()[effects[i]].parameters.size();
  return at;
}

Fit fit_from(const ForwardModel& model, const std::vector<std::size_t>& effects,
             const std::vector<std::vector<double>>& starts, const std::vector<bool>& trained,
             const Eigen::MatrixXd& held, const MustBeat& must_beat) {
  const FitProblem on(model, effects, trained);
  std::vector<Descent> ends = first_moves(on, starts, held);
  Descent& best = ends.front();
  const auto given_up = [&] {
    return Fit{effects, best.values, {}, {}, {}, best.cost, "explains too little"};
  };
  if (best.cost > must_beat.after_first_moves) return given_up();
  best = descend(on, best.values, most_iterations);
  if (best.cost > must_beat.at_rest) return given_up();
  if (best.converged) certify(on, ends);

  Fit fit{effects, best.values, best.residuals, best.slopes, {}, best.cost, {}};
  if (fit.slopes.size() == 0) {
    const auto residuals = model.residuals(effects, fit.values, trained);
    const auto slopes = residuals ? jacobian(on, fit.values, *residuals) : std::nullopt;
    if (!slopes) {
      fit.not_certified = "the model cannot be evaluated where the fit ended";
      return fit;
    }
    fit.residuals = *residuals;
    fit.slopes = *slopes;
  }
  fit.covariance = clustered_covariance(on, fit.slopes, fit.residuals);
  fit.not_certified = certificate(ends, on.parameters, fit.covariance);
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
  return fit_from(model, effects, starts, trained, before.slopes, must_beat);
}

Evaluated refit(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained) {
  const FitProblem on(model, fit.effects, trained);
  auto settled = settle(on, {fit.values, fit.residuals}, fit.slopes);
  if (settled) return std::move(*settled);
  const Descent end = descend(on, fit.values, most_refit_iterations);
  auto residuals = model.residuals(fit.effects, end.values, trained);
  return {end.values, residuals ? std::move(*residuals) : Eigen::VectorXd()};
}

}  // namespace rvbench::analysis
