#include <Eigen/QR>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {
namespace {

using Factors = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;

Factors factors_of(const Eigen::MatrixXd& a, double threshold) {
  Factors factors;
  factors.setThreshold(threshold);
  factors.compute(a);
  return factors;
}

}  // namespace

ComplexLeastSquares::ComplexLeastSquares(const Eigen::MatrixXcd& a)
    : factors_(std::make_shared<const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>>(a)) {}

Eigen::VectorXcd ComplexLeastSquares::solve(const Eigen::VectorXcd& b) const {
  return factors_->solve(b);
}

Eigen::MatrixXcd least_squares(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  return a.householderQr().solve(b);
}

Eigen::MatrixXcd orthonormal_columns(const Eigen::MatrixXcd& a) {
  return a.householderQr().householderQ() * Eigen::MatrixXcd::Identity(a.rows(), a.cols());
}

Eigen::MatrixXd basis_of_columns(const Eigen::MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(a);
  return factors.householderQ() * Eigen::MatrixXd::Identity(a.rows(), factors.rank());
}

Eigen::Index rank(const Eigen::MatrixXd& a) { return a.colPivHouseholderQr().rank(); }

MinimumNorm::MinimumNorm(const Eigen::MatrixXd& a) : factors_(std::make_shared<const Factors>(a)) {}

MinimumNorm::MinimumNorm(const Eigen::MatrixXd& a, double threshold)
    : factors_(std::make_shared<const Factors>(factors_of(a, threshold))) {}

Eigen::VectorXd MinimumNorm::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }

Eigen::MatrixXd MinimumNorm::pseudo_inverse() const { return factors_->pseudoInverse(); }

}  // namespace rvbench::algebra
