#include "sim/terms/shaft_torsion.hpp"

#include <stdexcept>

namespace rvbench::sim {
namespace {

void add_between(Eigen::MatrixXd& m, int a, int b, double value) {
  m(a, a) += value;
  m(b, b) += value;
  m(a, b) -= value;
  m(b, a) -= value;
}

}  // namespace

ShaftTorsion::ShaftTorsion(const Params& p) : p_(p) {
  if (!(p.stiffness_Nm_rad >= 0 && p.damping_Nms_rad >= 0)) {
    throw std::invalid_argument("shaft_torsion: stiffness and damping must be >= 0");
  }
}

double ShaftTorsion::torque_Nm(const PlantState& s) const {
  return p_.stiffness_Nm_rad * (s.q[p_.body_a] - s.q[p_.body_b]) +
         p_.damping_Nms_rad * (s.v[p_.body_a] - s.v[p_.body_b]);
}

void ShaftTorsion::add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  const double torque = torque_Nm(s);
  f[p_.body_a] -= torque;
  f[p_.body_b] += torque;
}

double ShaftTorsion::stored_energy_J(const PlantState& s) const {
  const double twist_rad = s.q[p_.body_a] - s.q[p_.body_b];
  return 0.5 * p_.stiffness_Nm_rad * twist_rad * twist_rad;
}

double ShaftTorsion::dissipated_power_W(const PlantState& s) const {
  const double rate_rad_s = s.v[p_.body_a] - s.v[p_.body_b];
  return p_.damping_Nms_rad * rate_rad_s * rate_rad_s;
}

void ShaftTorsion::add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const {
  add_between(stiffness, p_.body_a, p_.body_b, p_.stiffness_Nm_rad);
  add_between(damping, p_.body_a, p_.body_b, p_.damping_Nms_rad);
}

}  // namespace rvbench::sim
