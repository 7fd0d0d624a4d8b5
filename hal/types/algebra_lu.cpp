#include <Eigen/LU>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

ComplexLu::ComplexLu(const Eigen::MatrixXcd& a)
    : factors_(std::make_shared<const Eigen::PartialPivLU<Eigen::MatrixXcd>>(a)) {}

Eigen::VectorXcd ComplexLu::solve(const Eigen::VectorXcd& b) const { return factors_->solve(b); }

Eigen::MatrixXcd ComplexLu::solve(const Eigen::MatrixXcd& b) const { return factors_->solve(b); }

double ComplexLu::reciprocal_condition() const { return factors_->rcond(); }

Eigen::MatrixXd inverse(const Eigen::MatrixXd& a) { return a.inverse(); }

std::optional<Eigen::MatrixXd> inverse_if_regular(const Eigen::MatrixXd& a) {
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(a);
  if (!factors.isInvertible()) return std::nullopt;
  return factors.inverse();
}

Eigen::MatrixXcd inverse_by_full_pivots(const Eigen::MatrixXcd& a) {
  return a.fullPivLu().inverse();
}

Eigen::VectorXcd solve_by_full_pivots(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b) {
  return a.fullPivLu().solve(b);
}

}  // namespace rvbench::algebra
