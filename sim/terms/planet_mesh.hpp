#pragma once

#include "sim/periodic_table.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Mesh of the sun with one planet that sits in a turning carrier.
///
///     α = θs − θc − β                       sun angle as this planet sees it, β its place
///     δ = rs·(θs − θc) − rp·ψ + e_s(α) + e_p(ψ)    tooth deflection [m], positive = pressed
///     F = k·(1 + ε(α))·δ + c·(rs·(ωs − ωc) − rp·dψ/dt)
///     τs = −rs·F,  τc = +rs·F,  τψ = +rp·F
///
/// ψ is the planet's angle against the carrier, counted positive in its own (opposite) sense.
/// In plant files e and ε are few numbers each: what comes with every tooth of the sun (harmonics
/// h = 1..4 of its z teeth per turn, falling as 1/h), from tooth to tooth (harmonics h of its
/// turn), an eccentric planet, one lost flank. See planet_mesh().
///
/// Leaves out: backlash, the slope of e and k over the line of action (de/dθ << r), and the rate of
/// e in the damper.
/// Source: Kahraman, J. Mech. Des. 116, 713-720 (1994), eqs. 1-4, reduced to rotation
class PlanetMesh final : public PhysicsTerm {
 public:
  struct Params {
    int sun = 0;
    int carrier = 0;
    int planet = 0;
    double place_rad = 0;             ///< β
    double sun_base_radius_m = 0;     ///< rs > 0
    double planet_base_radius_m = 0;  ///< rp > 0
    double sun_teeth = 9;             ///< z
    double stiffness_N_m = 0;         ///< k > 0
    double damping_Ns_m = 0;          ///< c >= 0
    PeriodicTable sun_error_m;        ///< e_s over α
    PeriodicTable planet_error_m;     ///< e_p over ψ
    PeriodicTable stiffness_ripple;   ///< ε over α, relative
  };

  /// @throws std::invalid_argument naming the first parameter out of range
  explicit PlanetMesh(Params p);

  std::string_view name() const override { return "planet_mesh"; }
  double effort(const PlantState& s) const override { return p_.sun_base_radius_m * force_N(s); }
  void add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;
  double stored_energy_J(const PlantState& s) const override;
  double dissipated_power_W(const PlantState& s) const override;
  void add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const override;
  void add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const override;
  void add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const override;

  double force_N(const PlantState& s) const;  ///< along the line of action, positive = pressed
  double seen_angle_rad(const PlantState& s) const;                              ///< α
  double planet_angle_rad(const PlantState& s) const { return s.q[p_.planet]; }  ///< ψ
  double place_in_housing_rad(const PlantState& s) const { return s.q[p_.carrier] + p_.place_rad; }
  double planet_teeth() const {
    return p_.sun_teeth * p_.planet_base_radius_m / p_.sun_base_radius_m;
  }
  const Params& params() const { return p_; }

 private:
  double pressed_m(const PlantState& s) const;  ///< rs·(θs − θc) − rp·ψ, without errors
  double rate_m_s(const PlantState& s) const;
  void apply(double force_N, Eigen::Ref<Eigen::VectorXd> f) const;

  Params p_;
};

/// body_a: the sun; body_b: the planet; carrier: the body that the planet sits in.
TermType planet_mesh();

}  // namespace rvbench::sim
