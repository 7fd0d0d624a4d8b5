#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sim/dry_contacts.hpp"
#include "sim/plant_model.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {

/// A plant that is driven while it runs, integrated at a fixed step.
///
///     M·dv/dt = −K·q − C·v + r(q, v, z, u, t),   dq/dt = v,   dz/dt = g(q, v, z, u)
///
/// The linear part is stepped exactly by its matrix exponential, whatever its stiffness; the
/// remainder r is extrapolated linearly over the step (second-order Adams-Bashforth inside the
/// exponential integrator), so one evaluation per step is all it costs. Dry friction whose turn
/// at standstill the step does not resolve is solved for, as FourStage does.
///
/// Accuracy  second order in step_s in r; exact in K and C
/// Source    Cox & Matthews, J. Comput. Phys. 176, 430-455 (2002), eq. (13)
class Plant {
 public:
  /// @throws std::invalid_argument if an inertia or the step is not positive, or the motion of a
  ///         body is prescribed
  Plant(PlantModel model, double step_s);

  /// Sets an input, in its channel's unit, from now on. @param i  its place in PlantState::u
  void set_input(std::size_t i, double value);
  void step();

  const PlantState& state() const { return state_; }
  double step_s() const { return step_s_; }
  double kinetic_energy_J() const;
  const std::vector<std::unique_ptr<PhysicsTerm>>& terms() const { return model_.terms; }

  /// Adds `turns` to the coordinates. The caller vouches that no term can tell: whole periods.
  void shift(const Eigen::VectorXd& turns_rad) {
    y_.head(turns_rad.size()) += turns_rad;
    load(y_);
  }

 private:
  std::vector<const DryFriction*> steep_frictions() const;
  void sort_terms();
  void set_flow();
  void read_remainder();
  void load(const Eigen::VectorXd& x);

  PlantModel model_;
  double step_s_;
  std::vector<const PhysicsTerm*> smooth_;  ///< with a remainder that no contact carries
  std::vector<const TermMemory*> memories_;
  DryContacts contacts_;
  PlantState state_;
  Eigen::Index states_, rates_;  ///< sizes of [q; v; z], and of r: forces, then rates of z
  Eigen::VectorXd y_;            ///< [q; v; z], r, r of the step before
  Eigen::MatrixXd flow_;         ///< one step on: [q; v; z] = flow·y
  Eigen::MatrixXd gamma0_;       ///< how a constant force over a step answers
  Eigen::VectorXd next_, foreseen_;
  long steps_ = 0;
};

}  // namespace rvbench::sim
