#pragma once

#include "sim/physics_term.hpp"

namespace rvbench::sim {

/// Dry and viscous friction of one body against the housing.
///
///     τ = −T_c·tanh(v / v_ε) − b·v
///
/// The tanh stands for the jump at standstill: below v_ε the body creeps instead of sticking.
/// Serves bearings (constant T_c) and a friction brake (T_c commanded).
/// Leaves out: stiction, Stribeck's curve, dependence on load and temperature.
/// Source: Armstrong-Hélouvry, Dupont & Canudas de Wit, Automatica 30(7), 1083-1138 (1994), §2
class Friction final : public PhysicsTerm {
 public:
  struct Params {
    int body = 0;
    double coulomb_Nm = 0;         ///< T_c >= 0
    double viscous_Nms_rad = 0;    ///< b >= 0
    double creep_speed_rad_s = 1;  ///< v_ε > 0
  };

  /// @throws std::invalid_argument naming the first parameter out of range
  explicit Friction(const Params& p);

  void set_coulomb_Nm(double torque_Nm) { p_.coulomb_Nm = torque_Nm; }

  std::string_view name() const override { return "friction"; }
  void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;
  double stored_energy_J(const PlantState&) const override { return 0; }
  double dissipated_power_W(const PlantState& s) const override;
  void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const override;
  void add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;

 private:
  double dry_Nm(const PlantState& s) const;

  Params p_;
};

}  // namespace rvbench::sim
