#include <unsupported/Eigen/MatrixFunctions>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                        const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return a * b;
}

Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                         const Eigen::Ref<const Eigen::MatrixXcd>& b) {
  return a * b;
}

Eigen::MatrixXd gram(const Eigen::Ref<const Eigen::MatrixXd>& a) { return a.transpose() * a; }

Eigen::MatrixXd exponential(const Eigen::MatrixXd& a) { return a.exp(); }

}  // namespace rvbench::algebra
