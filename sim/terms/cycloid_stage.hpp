#pragma once

#include "sim/periodic_table.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

/// One crank's share of the cycloid stage: the crank swings the discs, the pins hold them, the
/// carrier follows.
///
///     φ = ψ − θc                                crank angle in the housing
///     D = ψ/zp − θc + e(φ)                      deflection at the carrier [rad]
///     τ = k·D + c·(dψ/dt/zp − ωc);   τψ = −τ/zp,  τc = +τ
///
/// e holds the stage's transmission error per crank orbit: pin-lobe pass (harmonic zp), eccentric
/// crank (harmonic 1), one bad pin (a bump per disc).
/// Leaves out: clearance, load sharing among pins, hysteresis, the slope de/dφ.
/// Source: Blanche & Yang, J. Mech. Des. 111(3), 337-344 (1989), for the transmission error
class CycloidStage final : public PhysicsTerm {
 public:
  struct Params {
    int crank = 0;
    int carrier = 0;
    double pins = 0;                 ///< zp, whole, > 0
    double pin_circle_radius_m = 0;  ///< > 0: where a length of error becomes an angle
    double stiffness_Nm_rad = 0;     ///< k > 0, at the carrier
    double damping_Nms_rad = 0;      ///< c >= 0
    PeriodicTable error_rad;         ///< e over φ
  };

  /// @throws std::invalid_argument naming the first parameter out of range
  explicit CycloidStage(Params p);

  std::string_view name() const override { return "cycloid_stage"; }
  double effort(const PlantState& s) const override { return torque_Nm(s) / p_.pins; }
  void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;
  double stored_energy_J(const PlantState& s) const override;
  double dissipated_power_W(const PlantState& s) const override;
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override;
  void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const override;
  void add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;

  double torque_Nm(const PlantState& s) const;        ///< on the carrier
  double orbit_angle_rad(const PlantState& s) const;  ///< φ
  const Params& params() const { return p_; }

 private:
  double deflection_rad(const PlantState& s) const;  ///< with e
  double rate_rad_s(const PlantState& s) const;
  void apply(double torque_Nm, Eigen::Ref<Eigen::VectorXd> f) const;

  Params p_;
};

/// body_a: the crank; body_b: the carrier.
TermType cycloid_stage();

}  // namespace rvbench::sim
