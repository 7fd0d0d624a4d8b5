#include "sim/terms/cycloid_stage.hpp"

#include <stdexcept>

namespace rvbench::sim {

CycloidStage::CycloidStage(Params p) : p_(std::move(p)) {
  if (p_.pins < 1) throw std::invalid_argument("cycloid_stage: pins must be >= 1");
  if (!(p_.stiffness_Nm_rad > 0 && p_.damping_Nms_rad >= 0)) {
    throw std::invalid_argument("cycloid_stage: stiffness must be > 0 and damping >= 0");
  }
}

double CycloidStage::orbit_angle_rad(const PlantState& s) const {
  return s.q[p_.crank] - s.q[p_.carrier];
}

double CycloidStage::deflection_rad(const PlantState& s) const {
  return s.q[p_.crank] / p_.pins - s.q[p_.carrier] + p_.error_rad(orbit_angle_rad(s));
}

double CycloidStage::rate_rad_s(const PlantState& s) const {
  return s.v[p_.crank] / p_.pins - s.v[p_.carrier];
}

double CycloidStage::torque_Nm(const PlantState& s) const {
  return p_.stiffness_Nm_rad * deflection_rad(s) + p_.damping_Nms_rad * rate_rad_s(s);
}

void CycloidStage::apply(double torque_Nm, Eigen::Ref<Eigen::VectorXd> f) const {
  f[p_.crank] -= torque_Nm / p_.pins;
  f[p_.carrier] += torque_Nm;
}

void CycloidStage::add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  apply(torque_Nm(s), f);
}

void CycloidStage::add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  apply(p_.stiffness_Nm_rad * p_.error_rad(orbit_angle_rad(s)), f);
}

double CycloidStage::stored_energy_J(const PlantState& s) const {
  const double d = deflection_rad(s);
  return 0.5 * p_.stiffness_Nm_rad * d * d;
}

double CycloidStage::dissipated_power_W(const PlantState& s) const {
  const double rate = rate_rad_s(s);
  return p_.damping_Nms_rad * rate * rate;
}

void CycloidStage::add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const {
  Eigen::VectorXd arm = Eigen::VectorXd::Zero(stiffness.rows());
  arm[p_.crank] = 1.0 / p_.pins;
  arm[p_.carrier] = -1;
  stiffness += p_.stiffness_Nm_rad * arm * arm.transpose();
  damping += p_.damping_Nms_rad * arm * arm.transpose();
}

}  // namespace rvbench::sim
