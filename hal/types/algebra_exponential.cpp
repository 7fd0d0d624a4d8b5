#include <unsupported/Eigen/MatrixFunctions>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& a) { return a.exp(); }

}  // namespace rvbench::algebra
