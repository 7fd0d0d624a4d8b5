#pragma once

#include <Eigen/Core>

namespace rvbench::sim {

/// The exact flow of a linear system over one step, and how it answers a push within the step.
///
///     dx/dt = A·x + B·r(s),   r(s) = r0 + r1·(s/h) + r2·(s/h)²/2
///     x(h)  = φ·x + Γ0·r0 + Γ1·r1 + Γ2·r2,   Γk = ∫ exp(A·(h − s))·(s/h)^k/k! ds·B
///
/// Source    Van Loan, IEEE Trans. Automat. Control 23(3), 395-404 (1978): all from one exponential
struct LinearFlow {
  /// @param a  n x n  @param b  n x m  @param step_s  > 0
  LinearFlow(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double step_s);

  Eigen::MatrixXd phi;     ///< n x n
  Eigen::MatrixXd gamma0;  ///< n x m, as the others
  Eigen::MatrixXd gamma1;
  Eigen::MatrixXd gamma2;
};

/// A and B of bodies on springs and dampers: x = [q; v], M·dv/dt = −K·q − C·v + r.
struct LinearBodies {
  /// @param inertia  n values > 0  @param stiffness, damping  n x n
  LinearBodies(const Eigen::VectorXd& inertia, const Eigen::MatrixXd& stiffness,
               const Eigen::MatrixXd& damping);

  Eigen::MatrixXd a;  ///< 2n x 2n
  Eigen::MatrixXd b;  ///< 2n x n
};

}  // namespace rvbench::sim
