#include "analysis/explain/ceiling.hpp"

#include <cmath>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

constexpr double ridge = 1e-3;  // of the mean power of a feature: shrinks what little data show

// Columns of zero mean and unit deviation; constant ones become zero.
Eigen::MatrixXd standardised(Eigen::MatrixXd x) {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    x.col(c).array() -= x.col(c).mean();
    const double deviation = std::sqrt(x.col(c).squaredNorm() / static_cast<double>(x.rows()));
    if (deviation > 0) x.col(c) /= deviation;
  }
  return x;
}

// 1, all products up to the third degree, signs, magnitudes and signed squares.
Eigen::MatrixXd features_of(const Eigen::MatrixXd& states) {
  const Eigen::MatrixXd x = standardised(states);
  const Eigen::Index n = x.cols();
  std::vector<Eigen::VectorXd> columns{Eigen::VectorXd::Ones(x.rows())};
  for (Eigen::Index i = 0; i < n; ++i) {
    columns.emplace_back(x.col(i));
    columns.emplace_back(states.col(i).array().sign());
    columns.emplace_back(x.col(i).array().abs());
    columns.emplace_back(x.col(i).array().abs() * x.col(i).array());
    for (Eigen::Index j = i; j < n; ++j) {
      columns.emplace_back(x.col(i).array() * x.col(j).array());
      for (Eigen::Index k = j; k < n; ++k) {
        columns.emplace_back(x.col(i).array() * x.col(j).array() * x.col(k).array());
      }
    }
  }
  Eigen::MatrixXd features(x.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) {
    features.col(static_cast<Eigen::Index>(c)) = columns[c];
  }
  return features;
}

}  // namespace

Ceiling flexible_ceiling(const Tryout& on, const Standing& standing) {
  Ceiling ceiling;
  const Eigen::MatrixXd states = on.model.states();
  if (states.rows() != standing.fit.residuals.size() || states.cols() == 0) return ceiling;
  const Eigen::MatrixXd features = features_of(states);

  HeldOut flexible{{}, standing.held_out.log_density, 0};
  Eigen::Index at = 0;
  double sum = 0, values = 0;
  for (const Fold& fold : on.conditions) {
    const Eigen::VectorXd residuals = refit(on.model, standing.fit, fold.trained()).residuals;
    if (residuals.size() == 0) return ceiling;
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(features.cols(), features.cols());
    Eigen::VectorXd products = Eigen::VectorXd::Zero(features.cols());
    double count = 0, power = 0;
    for (std::size_t u = 0; u < fold.held_out.size(); ++u) {
      if (fold.held_out[u]) continue;
      const ObservedUnit& unit = on.model.units()[u];
      const auto f = features.middleRows(unit.first, unit.size);
      const auto r = residuals.segment(unit.first, unit.size);
      squares += algebra::gram(f);
      products.noalias() += f.transpose() * r;
      count += static_cast<double>(unit.size);
      power += r.squaredNorm();
    }
    squares.diagonal().array() += ridge * count;
    const Eigen::VectorXd weights = algebra::SymmetricFactors(squares).solve(products);
    const double left = power - 2 * weights.dot(products) + weights.dot(squares * weights);
    const double scatter = std::max(left, 1e-12 * power) / count;
    for (std::size_t u = 0; u < fold.held_out.size(); ++u) {
      if (!fold.held_out[u]) continue;
      const ObservedUnit& unit = on.model.units()[u];
      const Eigen::VectorXd apart = residuals.segment(unit.first, unit.size) -
                                    features.middleRows(unit.first, unit.size) * weights;
      flexible.log_density[at++] = log_density_of(apart, scatter, on.counts_as);
      sum += apart.squaredNorm();
      values += static_cast<double>(unit.size);
    }
  }
  ceiling.known = true;
  ceiling.error = values > 0 ? std::sqrt(sum / values) : 0;
  ceiling.over_model = margin(flexible, standing.held_out);
  return ceiling;
}

}  // namespace rvbench::analysis
