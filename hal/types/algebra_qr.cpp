#include <Eigen/QR>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

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

}  // namespace rvbench::algebra
