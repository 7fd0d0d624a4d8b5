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

MinimumNorm::MinimumNorm(const Eigen::MatrixXd& a) : factors_(std::make_shared<const Factors>(a)) {}

MinimumNorm::MinimumNorm(const Eigen::MatrixXd& a, double threshold)
    : factors_(std::make_shared<const Factors>(factors_of(a, threshold))) {}

Eigen::VectorXd MinimumNorm::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }

Eigen::MatrixXd MinimumNorm::pseudo_inverse() const { return factors_->pseudoInverse(); }

}  // namespace rvbench::algebra
