#include "analysis/explain/predictive_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "analysis/statistics.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

// y = a + b·x of least squares, neither below 0.
struct Line {
  double a = 0, b = 0;
};

Line line_through(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const double variance = (x - x.mean()).square().sum();
  const double b = variance > 0 ? ((x - x.mean()) * (y - y.mean())).sum() / variance : 0;
  if (b <= 0) return {y.mean(), 0};
  if (const double a = y.mean() - b * x.mean(); a >= 0) return {a, b};
  return {0, (x * y).sum() / x.square().sum()};
}

struct Condition {
  std::vector<const ObservedUnit*> units;
  Eigen::MatrixXd squares;   // JᵀJ
  Eigen::VectorXd gradient;  // Jᵀr
};

std::map<std::string, Condition> conditions_of(const ForwardModel& model,
                                               const Eigen::MatrixXd& slopes,
                                               const Eigen::VectorXd& residuals) {
  const Eigen::Index n = slopes.cols();
  std::map<std::string, Condition> conditions;
  for (const ObservedUnit& unit : model.units()) {
    const Condition none{{}, Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    Condition& condition = conditions.try_emplace(unit.condition, none).first->second;
    const auto j = slopes.middleRows(unit.first, unit.size);
    condition.units.push_back(&unit);
    condition.squares += algebra::gram(j);
    condition.gradient += j.transpose() * residuals.segment(unit.first, unit.size);
  }
  return conditions;
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& m) {
  return m.size() > 0 ? algebra::MinimumNorm(m).pseudo_inverse() : m;
}

}  // namespace

PredictiveError::PredictiveError(const ForwardModel& model, const Fit& fit) {
  if (fit.residuals.size() == 0) throw std::invalid_argument("PredictiveError: no residuals");
  const auto n = static_cast<Eigen::Index>(fit.values.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(fit.residuals.size(), n);
  if (fit.slopes.cols() == n) slopes = fit.slopes;
  const auto conditions = conditions_of(model, slopes, fit.residuals);
  const auto count = static_cast<double>(conditions.size());
  freedom_ = std::max(count - static_cast<double>(n), 1.0);
  const Eigen::MatrixXd squares = algebra::gram(slopes);
  covariance_ = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd left_out = fit.residuals;
  for (const auto& [name, condition] : conditions) {
    const Eigen::VectorXd away = inverse(squares - condition.squares) * condition.gradient;
    covariance_ += (count - 1) / count * away * away.transpose();
    for (const ObservedUnit* unit : condition.units) {
      left_out.segment(unit->first, unit->size) +=
          slopes.middleRows(unit->first, unit->size) * away;
    }
  }
  const Eigen::ArrayXd known =
      algebra::product(slopes, covariance_).cwiseProduct(slopes).rowwise().sum();
  const Line line = line_through(known, left_out.array().square());
  everywhere_ = line.a;
  grows_ = line.b;
}

double PredictiveError::half_width_90(const Eigen::VectorXd& slope) const {
  const double known = slope.size() > 0 ? slope.dot(covariance_ * slope) : 0;
  return t_of_p_value(0.1, freedom_) * std::sqrt(everywhere_ + grows_ * known);
}

}  // namespace rvbench::analysis
