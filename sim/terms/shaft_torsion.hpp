#pragma once

#include "sim/physics_term.hpp"

namespace rvbench::sim {

/// Linear torsional spring-damper between two bodies on one axis.
///
///     τ = k·(qa − qb) + c·(va − vb);   τa = −τ,  τb = +τ
///
/// Leaves out: backlash, hysteresis of a rubber coupling.
/// Source: Rao, Mechanical Vibrations, ch. 1 (Kelvin-Voigt element)
class ShaftTorsion final : public PhysicsTerm {
 public:
  struct Params {
    int body_a = 0;
    int body_b = 1;
    double stiffness_Nm_rad = 0;  ///< k >= 0
    double damping_Nms_rad = 0;   ///< c >= 0
  };

  /// @throws std::invalid_argument naming the first parameter out of range
  explicit ShaftTorsion(const Params& p);

  std::string_view name() const override { return "shaft_torsion"; }
  void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;
  double stored_energy_J(const PlantState& s) const override;
  double dissipated_power_W(const PlantState& s) const override;
  void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const override;
  void add_remainder(const PlantState&, Eigen::Ref<Eigen::VectorXd>) const override {}

  double torque_Nm(const PlantState& s) const;  ///< passed from a to b

 private:
  Params p_;
};

}  // namespace rvbench::sim
