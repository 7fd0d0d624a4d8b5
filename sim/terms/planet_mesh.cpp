#include "sim/terms/planet_mesh.hpp"

#include <stdexcept>

namespace rvbench::sim {

PlanetMesh::PlanetMesh(Params p) : p_(std::move(p)) {
  if (!(p_.sun_base_radius_m > 0 && p_.planet_base_radius_m > 0)) {
    throw std::invalid_argument("planet_mesh: base radii must be > 0");
  }
  if (!(p_.stiffness_N_m > 0 && p_.damping_Ns_m >= 0)) {
    throw std::invalid_argument("planet_mesh: stiffness must be > 0 and damping >= 0");
  }
}

double PlanetMesh::seen_angle_rad(const PlantState& s) const {
  return s.q[p_.sun] - s.q[p_.carrier] - p_.place_rad;
}

double PlanetMesh::pressed_m(const PlantState& s) const {
  return p_.sun_base_radius_m * (s.q[p_.sun] - s.q[p_.carrier]) -
         p_.planet_base_radius_m * s.q[p_.planet];
}

double PlanetMesh::rate_m_s(const PlantState& s) const {
  return p_.sun_base_radius_m * (s.v[p_.sun] - s.v[p_.carrier]) -
         p_.planet_base_radius_m * s.v[p_.planet];
}

double PlanetMesh::force_N(const PlantState& s) const {
  const double seen_rad = seen_angle_rad(s);
  const double deflection_m =
      pressed_m(s) + p_.sun_error_m(seen_rad) + p_.planet_error_m(s.q[p_.planet]);
  return p_.stiffness_N_m * (1 + p_.stiffness_ripple(seen_rad)) * deflection_m +
         p_.damping_Ns_m * rate_m_s(s);
}

void PlanetMesh::apply(double force_N, Eigen::Ref<Eigen::VectorXd> f) const {
  f[p_.sun] -= p_.sun_base_radius_m * force_N;
  f[p_.carrier] += p_.sun_base_radius_m * force_N;
  f[p_.planet] += p_.planet_base_radius_m * force_N;
}

void PlanetMesh::add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  apply(force_N(s), f);
}

void PlanetMesh::add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  const double linear_N = p_.stiffness_N_m * pressed_m(s) + p_.damping_Ns_m * rate_m_s(s);
  apply(force_N(s) - linear_N, f);
}

double PlanetMesh::stored_energy_J(const PlantState& s) const {
  const double seen_rad = seen_angle_rad(s);
  const double deflection_m =
      pressed_m(s) + p_.sun_error_m(seen_rad) + p_.planet_error_m(s.q[p_.planet]);
  return 0.5 * p_.stiffness_N_m * (1 + p_.stiffness_ripple(seen_rad)) * deflection_m * deflection_m;
}

double PlanetMesh::dissipated_power_W(const PlantState& s) const {
  const double rate = rate_m_s(s);
  return p_.damping_Ns_m * rate * rate;
}

void PlanetMesh::add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const {
  Eigen::VectorXd arm_m = Eigen::VectorXd::Zero(stiffness.rows());
  arm_m[p_.sun] = p_.sun_base_radius_m;
  arm_m[p_.carrier] = -p_.sun_base_radius_m;
  arm_m[p_.planet] = -p_.planet_base_radius_m;
  stiffness += p_.stiffness_N_m * arm_m * arm_m.transpose();
  damping += p_.damping_Ns_m * arm_m * arm_m.transpose();
}

}  // namespace rvbench::sim
