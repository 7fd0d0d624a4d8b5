#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/dry_contacts.hpp"
#include "sim/plant_model.hpp"
#include "sim/term_memory.hpp"

namespace rvbench::sim {

/// Steps a plant under given inputs: bodies that move freely, bodies whose motion is prescribed,
/// terms that remember.
///
/// The linear part is stepped exactly by its matrix exponential; the rest takes four evaluations
/// per step (Runge-Kutta inside the exponential integrator). Dry friction is held constant over a
/// step at the value at which the speed it leads to is the speed it belongs to, so it sticks and
/// slips at any creep speed.
///
/// Accuracy  exact for a linear plant and inputs that are parabolas within a step; order 4 in the
///           step for smooth forces, 2 where a force has a kink; a reversal of dry friction is
///           placed to within one step
/// Source    Cox & Matthews, J. Comput. Phys. 176, 430-455 (2002), eqs. 26-29
class FourStage {
 public:
  /// @param model  outlives it
  FourStage(const PlantModel& model, double step_s);

  /// @param si  signals as PlantModel::taps orders them, SI, at t = 0
  void start(const double* si);
  /// One step on. @param si0, si1, si2  signals at its start, middle and end
  void step(const double* si0, const double* si1, const double* si2);

  const PlantState& state() const { return state_; }
  /// Of a body whose motion is prescribed, by its place in PlantModel::prescribed.
  double prescribed_acceleration(std::size_t i) const { return accelerations_[i]; }
  /// Sum of all forces on each body in the present state. @param f  one per body, out
  void forces(Eigen::Ref<Eigen::VectorXd> f) const;
  /// Whether position and speed of every free body are finite and below 1e9 m, rad, m/s, rad/s.
  bool in_bounds() const;

 private:
  void split_linear_part();
  void set_signals(const double* si, double t_s);
  void set_state(const Eigen::VectorXd& x);
  void remainder(Eigen::VectorXd& r);
  void middle_stages();

  const PlantModel& model_;
  double step_s_;
  std::vector<int> free_;
  std::vector<const PhysicsTerm*> smooth_;  ///< with a remainder that no contact carries
  std::vector<const TermMemory*> memories_;
  DryContacts contacts_;

  Eigen::MatrixXd phi_half_, gamma_half_, phi_, first_, middle_, last_;
  Eigen::MatrixXd coupling_;  ///< on free bodies, of prescribed positions and speeds
  PlantState state_;
  std::vector<double> accelerations_;
  Eigen::VectorXd x_, stage_, at_half_, next_;  ///< [q; v] of free bodies, then z
  Eigen::VectorXd r0_, ra_, rb_, rc_;           ///< forces on free bodies, then rates of z
  Eigen::VectorXd forces_, given_;
  long steps_ = 0;
};

}  // namespace rvbench::sim
