#include "hal/types/products.hpp"

namespace rvbench {

Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                        const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return a * b;
}

Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                         const Eigen::Ref<const Eigen::MatrixXcd>& b) {
  return a * b;
}

Eigen::MatrixXd gram(const Eigen::Ref<const Eigen::MatrixXd>& a) { return a.transpose() * a; }

}  // namespace rvbench
