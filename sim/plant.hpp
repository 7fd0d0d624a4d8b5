#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/physics_term.hpp"

namespace rvbench::sim {

/// Bodies and the terms between them, integrated at a fixed step.
///
///     M·dv/dt = −K·q − C·v + r(q, v),   dq/dt = v
///
/// The linear part is stepped exactly by its matrix exponential, whatever its stiffness; the
/// remainder r is extrapolated linearly over the step (second-order Adams-Bashforth inside the
/// exponential integrator), so one evaluation per step is all it costs.
///
/// Accuracy  second order in step_s in r; exact in K and C
/// Source    Cox & Matthews, J. Comput. Phys. 176, 430-455 (2002), eq. (13)
class Plant {
 public:
  /// @param inertia  kg·m² or kg of each body, > 0
  /// @throws std::invalid_argument if an inertia or the step is not positive
  Plant(Eigen::VectorXd inertia, std::vector<std::unique_ptr<PhysicsTerm>> terms, double step_s);

  void step();
  const PlantState& state() const { return state_; }
  double step_s() const { return step_s_; }
  double kinetic_energy_J() const;
  const std::vector<std::unique_ptr<PhysicsTerm>>& terms() const { return terms_; }

  /// Adds `turns` to the coordinates. The caller vouches that no term can tell: whole periods.
  void shift(const Eigen::VectorXd& turns_rad) {
    x_.head(turns_rad.size()) += turns_rad;
    load();
  }

 private:
  void load();

  Eigen::VectorXd inertia_;
  std::vector<std::unique_ptr<PhysicsTerm>> terms_;
  double step_s_;
  Eigen::MatrixXd phi_;     ///< exp(A·h)
  Eigen::MatrixXd gamma0_;  ///< ∫ exp(A·s) ds · B
  Eigen::MatrixXd gamma1_;  ///< the same, weighted with s/h: answers the slope of r
  PlantState state_;
  Eigen::VectorXd x_, next_;  ///< [q; v]
  Eigen::VectorXd r_, r_before_;
  bool has_before_ = false;
};

}  // namespace rvbench::sim
