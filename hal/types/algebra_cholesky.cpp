#include <Eigen/Cholesky>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

SymmetricFactors::SymmetricFactors(const Eigen::MatrixXd& a)
    : factors_(std::make_shared<const Eigen::LDLT<Eigen::MatrixXd>>(a)) {}

Eigen::VectorXd SymmetricFactors::solve(const Eigen::VectorXd& b) const {
  return factors_->solve(b);
}

Eigen::MatrixXd SymmetricFactors::solve(const Eigen::MatrixXd& b) const {
  return factors_->solve(b);
}

Eigen::MatrixXd SymmetricFactors::inverse() const {
  return factors_->solve(Eigen::MatrixXd::Identity(factors_->rows(), factors_->cols()));
}

double SymmetricFactors::log_determinant() const { return factors_->vectorD().array().log().sum(); }

Eigen::MatrixXcd inverse_of_positive(const Eigen::MatrixXcd& a) {
  return a.llt().solve(Eigen::MatrixXcd::Identity(a.rows(), a.cols()));
}

}  // namespace rvbench::algebra
