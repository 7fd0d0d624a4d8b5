#include "sim/terms/friction.hpp"

#include <stdexcept>

#include "sim/terms/dry_friction.hpp"

namespace rvbench::sim {

Friction::Friction(const Params& p) : p_(p) {
  if (!(p.coulomb_Nm >= 0 && p.viscous_Nms_rad >= 0)) {
    throw std::invalid_argument("friction: coulomb and viscous friction must be >= 0");
  }
  if (!(p.creep_speed_rad_s > 0)) throw std::invalid_argument("friction: creep speed must be > 0");
}

double Friction::dry_Nm(const PlantState& s) const {
  return p_.coulomb_Nm * creeping_sign(s.v[p_.body], p_.creep_speed_rad_s);
}

void Friction::add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  f[p_.body] -= dry_Nm(s) + p_.viscous_Nms_rad * s.v[p_.body];
}

double Friction::dissipated_power_W(const PlantState& s) const {
  const double v = s.v[p_.body];
  return dry_Nm(s) * v + p_.viscous_Nms_rad * v * v;
}

void Friction::add_linear(Eigen::MatrixXd&, Eigen::MatrixXd& damping) const {
  damping(p_.body, p_.body) += p_.viscous_Nms_rad;
}

void Friction::add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  f[p_.body] -= dry_Nm(s);
}

}  // namespace rvbench::sim
