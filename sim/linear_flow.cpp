#include "sim/linear_flow.hpp"

#include "hal/types/linear_algebra.hpp"

namespace rvbench::sim {

LinearFlow::LinearFlow(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double step_s) {
  const Eigen::Index n = a.rows();
  const Eigen::Index m = b.cols();
  if (n == 0) return;
  // exp of [A·h B·h 0 0; 0 0 I 0; 0 0 0 I; 0 0 0 0] holds phi and the three gammas side by side.
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n + 3 * m, n + 3 * m);
  block.topLeftCorner(n, n) = a * step_s;
  block.block(0, n, n, m) = b * step_s;
  block.block(n, n + m, m, m).setIdentity();
  block.block(n + m, n + 2 * m, m, m).setIdentity();
  const Eigen::MatrixXd exponential = algebra::exponential(block);
  phi = exponential.topLeftCorner(n, n);
  gamma0 = exponential.block(0, n, n, m);
  gamma1 = exponential.block(0, n + m, n, m);
  gamma2 = exponential.block(0, n + 2 * m, n, m);
}

LinearBodies::LinearBodies(const Eigen::VectorXd& inertia, const Eigen::MatrixXd& stiffness,
                           const Eigen::MatrixXd& damping) {
  const Eigen::Index n = inertia.size();
  const Eigen::VectorXd inverse_inertia = inertia.cwiseInverse();
  a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -(inverse_inertia.asDiagonal() * stiffness);
  a.bottomRightCorner(n, n) = -(inverse_inertia.asDiagonal() * damping);
  b = Eigen::MatrixXd::Zero(2 * n, n);
  b.bottomRows(n) = inverse_inertia.asDiagonal();
}

}  // namespace rvbench::sim
