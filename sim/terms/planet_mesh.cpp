#include "sim/terms/planet_mesh.hpp"

#include <cmath>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

constexpr int harmonics = 4;

ParameterCard gear_size(std::string name, UnitKind unit, double start) {
  return {.name = std::move(name),
          .unit = unit,
          .min = smallest,
          .max = unbounded,
          .start = start,
          .fitted = false};
}

ParameterCard deviation(std::string name, UnitKind unit) {
  return {
      .name = std::move(name), .unit = unit, .min = 0, .max = unbounded, .start = 0, .fallback = 0};
}

ParameterCard phase_of(std::string name) {
  return {.name = std::move(name),
          .unit = UnitKind::angle,
          .min = -unbounded,
          .max = unbounded,
          .start = 0,
          .fallback = 0};
}

PlanetMesh::Params params_of(const TermSite& at) {
  PlanetMesh::Params mesh{.sun = at.axis.body_a,
                          .carrier = at.body,
                          .planet = at.axis.body_b,
                          .place_rad = at["place"],
                          .sun_base_radius_m = at["sun_base_radius"],
                          .planet_base_radius_m = at["planet_base_radius"],
                          .sun_teeth = at["sun_teeth"],
                          .stiffness_N_m = at["stiffness"],
                          .damping_Ns_m = at["damping"],
                          .sun_error_m = {},
                          .planet_error_m = {},
                          .stiffness_ripple = {}};
  const double tooth_rad = at["profile_phase"];
  for (int h = 1; h <= harmonics; ++h) {
    const auto per_turn = static_cast<int>(h * mesh.sun_teeth);
    mesh.sun_error_m.add_cosine(per_turn, at["profile_error"] / h, h * tooth_rad);
    mesh.stiffness_ripple.add_cosine(per_turn, at["stiffness_ripple"] / h,
                                     h * tooth_rad + at["stiffness_ripple_phase"]);
    mesh.sun_error_m.add_cosine(h, at["sun_tooth_error"] / h, h * h * at["sun_tooth_phase"]);
  }
  mesh.planet_error_m.add_cosine(1, at["planet_eccentricity"], at["planet_eccentricity_phase"]);
  const double flank_rad =
      units::two_pi / (mesh.sun_teeth * mesh.planet_base_radius_m / mesh.sun_base_radius_m) / 3;
  mesh.planet_error_m.add_bump(at["lost_flank_place"], flank_rad, -at["lost_flank"]);
  return mesh;
}

}  // namespace

PlanetMesh::PlanetMesh(Params p) : p_(std::move(p)) {
  if (!(p_.sun_base_radius_m > 0 && p_.planet_base_radius_m > 0)) {
    throw std::invalid_argument("planet_mesh: base radii must be > 0");
  }
  if (!(p_.sun_teeth >= 1) || p_.sun_teeth != std::floor(p_.sun_teeth)) {
    throw std::invalid_argument("planet_mesh: sun_teeth must be a whole number >= 1");
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

void PlanetMesh::add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const {
  const double sun = turns[p_.sun] - turns[p_.carrier];
  std::set<int> errors;
  for (const int harmonic : p_.sun_error_m.harmonics()) add_order(harmonic * sun, errors);
  for (const int harmonic : p_.planet_error_m.harmonics()) {
    add_order(harmonic * turns[p_.planet], errors);
  }
  orders.insert(errors.begin(), errors.end());
  for (const int harmonic : p_.stiffness_ripple.harmonics()) {
    const double ripple = harmonic * sun;
    add_order(ripple, orders);
    for (const int error : errors) {
      add_order(error + ripple, orders);
      add_order(error - ripple, orders);
    }
  }
}

void PlanetMesh::add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const {
  Eigen::VectorXd arm_m = Eigen::VectorXd::Zero(stiffness.rows());
  arm_m[p_.sun] = p_.sun_base_radius_m;
  arm_m[p_.carrier] = -p_.sun_base_radius_m;
  arm_m[p_.planet] = -p_.planet_base_radius_m;
  stiffness += p_.stiffness_N_m * arm_m * arm_m.transpose();
  damping += p_.damping_Ns_m * arm_m * arm_m.transpose();
}

TermType planet_mesh() {
  return {
      .card = {.name = "planet_mesh",
               .effect = false,
               .equation = "F_t = k·(1 + ε(α))·(r_s·α + r_s·β − r_p·ψ + e_s(α) + e_p(ψ)) + "
                           "c·(r_s·dα/dt − r_p·dψ/dt), α = θ_s − θ_c − β; on the sun F = r_s·F_t",
               .sign = "a turning sun presses the teeth and drives planet and carrier forward; the "
                       "planet's angle ψ counts against the carrier, opposite to the sun's",
               .leaves_out = "backlash; the slope of e and ε along the line of action",
               .source = "Kahraman, J. Mech. Des. 116, 713-720 (1994), eqs. 1-4"},
      .parameters = {{.name = "place",
                      .unit = UnitKind::angle,
                      .min = -unbounded,
                      .max = unbounded,
                      .start = 0,
                      .fitted = false},
                     gear_size("sun_base_radius", UnitKind::length, 5e-3),
                     gear_size("planet_base_radius", UnitKind::length, 15e-3),
                     gear_size("sun_teeth", UnitKind::ratio, 9),
                     {.name = "stiffness",
                      .unit = UnitKind::contact_stiffness,
                      .min = smallest,
                      .max = unbounded,
                      .start = 1e8},
                     {.name = "damping",
                      .unit = UnitKind::contact_damping,
                      .min = 0,
                      .max = unbounded,
                      .start = 1e3},
                     deviation("stiffness_ripple", UnitKind::ratio),
                     phase_of("stiffness_ripple_phase"),
                     deviation("profile_error", UnitKind::length),
                     phase_of("profile_phase"),
                     deviation("sun_tooth_error", UnitKind::length),
                     phase_of("sun_tooth_phase"),
                     deviation("planet_eccentricity", UnitKind::length),
                     phase_of("planet_eccentricity_phase"),
                     deviation("lost_flank", UnitKind::length),
                     phase_of("lost_flank_place")},
      .gate = {.translation = false,
               .on_one = false,
               .reference = ReferenceKind::body,
               .reference_key = "carrier"},
      .make = [](const TermSite& at) { return std::make_unique<PlanetMesh>(params_of(at)); }};
}

}  // namespace rvbench::sim
