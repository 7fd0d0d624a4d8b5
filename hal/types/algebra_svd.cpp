#include <Eigen/SVD>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

Eigen::VectorXd singular_values(const Eigen::MatrixXcd& a) {
  return Eigen::JacobiSVD<Eigen::MatrixXcd>(a).singularValues();
}

RightSingular right_singular(const Eigen::MatrixXd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace rvbench::algebra
