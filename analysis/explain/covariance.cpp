#include "analysis/explain/covariance.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/explain/wave.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

constexpr double wave_step = 1e-3;  // of a size's scale, and of a radian

// Of a symmetric matrix whose rows are in different units; pseudo where it has none.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
  if (information.size() == 0) return information;
  Eigen::VectorXd scale = information.diagonal().cwiseSqrt();
  scale = (scale.array() > 0).select(scale.cwiseInverse(), 1.0);
  const Eigen::MatrixXd even = scale.asDiagonal() * information * scale.asDiagonal();
  return scale.asDiagonal() * algebra::MinimumNorm(even).pseudo_inverse() * scale.asDiagonal();
}

// Slopes of a fit with respect to as_waves(values): a wave whose phase leaves no trace has none in
// it, which the slopes of its two parts tell only but for their errors.
Eigen::MatrixXd waves_slopes(const FitProblem& on, const Fit& fit) {
  Eigen::MatrixXd slopes = fit.slopes;
  const std::vector<std::size_t> waves = waves_among(on.model, on.effects);
  const std::vector<double> at_rest = as_waves(fit.values, waves);
  for (const std::size_t at : waves) {
    for (const std::size_t i : {at, at + 1}) {
      const double step =
          i == at ? step_of_wave(wave_step * on.parameters[i].scale, at_rest[i]) : wave_step;
      const auto moved = [&](double by) {
        std::vector<double> values = at_rest;
        values[i] += by;
        return on.model.residuals(on.effects, from_waves(std::move(values), waves), on.trained);
      };
      const auto above = moved(step), below = moved(-step);
      if (!above || !below) continue;
      slopes.col(static_cast<Eigen::Index>(i)) = (*above - *below) / (2 * step);
    }
  }
  return slopes;
}

}  // namespace

void add_covariance(const FitProblem& on, Fit& fit) {
  const Eigen::MatrixXd slopes = waves_slopes(on, fit);
  const Eigen::VectorXd& residuals = fit.residuals;
  const Eigen::Index n = slopes.cols();
  if (n == 0) return;
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
  const Eigen::MatrixXd inverse = inverse_of(information_of(on, slopes));
  auto learned = static_cast<double>(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double spread = on.parameters[static_cast<std::size_t>(i)].spread;
    if (!std::isfinite(spread)) continue;
    scatter(i, i) += std::pow(on.scatter, 4) / (spread * spread);
    learned -= std::min(std::pow(on.scatter / spread, 2) * inverse(i, i), 1.0);
  }
  fit.freedom = std::max(units - learned, 1.0);
  fit.covariance = units / fit.freedom * inverse * scatter * inverse;
}

Eigen::VectorXd known_variances(const FitProblem& on, const Fit& fit) {
  return std::pow(on.scatter, 2) * inverse_of(information_of(on, waves_slopes(on, fit))).diagonal();
}

}  // namespace rvbench::analysis
