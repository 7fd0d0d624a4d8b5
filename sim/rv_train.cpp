#include "sim/rv_train.hpp"

#include <cmath>

#include "hal/types/units.hpp"
#include "sim/rv_20e.hpp"

namespace rvbench::sim {
namespace {

using units::two_pi;

// A 0.75 kW four-pole motor on a 230 V inverter, at rated 5 N·m: by Kloss's formula these give a
// rated slip of 3.3 %, of the article's 2.3 to 3.0 % below nominal speed. Ripple: assumed.
constexpr double pull_out_torque_Nm = 12;  // 2.4 times rated: assumed, as usual for such motors
constexpr double pull_out_slip = 0.15;
constexpr double torque_ripple = 0.02;

// Coupling and transducer in series: assumed, of the order of a small jaw coupling.
constexpr double coupling_stiffness_Nm_rad = 600;
constexpr double coupling_damping_Nms_rad = 0.05;

// No-load running torque at the input: assumed. Together 0.25 N·m at 1815 rpm.
constexpr double coulomb_Nm = 0.15;
constexpr double viscous_Nms_rad = 5e-4;
constexpr double creep_speed_rad_s = 2;

// ISO 6336-1: 14 N/(mm·µm) for steel, times a face width of 5.7 mm, which is assumed.
constexpr double mesh_stiffness_N_m = 8e7;
// A tenth of critical against the mesh's reduced mass of 76 g; Kasuba & Evans, J. Mech. Des. 103,
// 398-409 (1981), have 3 to 17 % for spur gears.
constexpr double mesh_damping_Ns_m = 1000;
// Share by which one and two pairs in contact differ, rounded by tip relief: assumed.
constexpr double mesh_ripple = 0.08;
constexpr int mesh_harmonics = 4;  // falling as 1/h: assumed

// All cranks together: assumed, half of critical against the carrier.
constexpr double cycloid_damping_Nms_rad = 80;

// Flange and shaft to the brake: assumed.
constexpr double output_stiffness_Nm_rad = 6e4;
constexpr double output_damping_Nms_rad = 20;

// Bearings of the brake, and the speed at which its dry friction changes sign: assumed.
constexpr double brake_viscous_Nms_rad = 0.5;
constexpr double brake_creep_speed_rad_s = 0.05;

// Moments of inertia [kg·m²]: the motor's as in catalogues of its frame size (IEC 80); the others
// assumed, as steel parts of the size that the RV-20E's housing leaves them.
constexpr double motor_inertia_kg_m2 = 2e-3;
constexpr double input_shaft_inertia_kg_m2 = 5e-5;
constexpr double crank_inertia_kg_m2 = 2e-5;  // with its planet
constexpr double carrier_inertia_kg_m2 = 0.03;
constexpr double brake_inertia_kg_m2 = 0.3;

template <typename Term>
Term* add(std::vector<std::unique_ptr<PhysicsTerm>>& terms, Term term) {
  auto owned = std::make_unique<Term>(std::move(term));
  Term* raw = owned.get();
  terms.push_back(std::move(owned));
  return raw;
}

PlanetMesh planet_mesh(const RvUnit& unit, int k) {
  const RvDeviations& d = unit.deviations;
  const std::vector<double>& phase = unit.phases_rad;
  const double profile_rad = phase[phase_of::mesh_profile];
  PlanetMesh::Params mesh{.sun = 1,
                          .carrier = 2 + unit.planets,
                          .planet = 2 + k,
                          .place_rad = two_pi * k / unit.planets,
                          .sun_base_radius_m = rv_20e::sun_base_radius_m,
                          .planet_base_radius_m = rv_20e::planet_base_radius_m,
                          .stiffness_N_m = mesh_stiffness_N_m,
                          .damping_Ns_m = mesh_damping_Ns_m,
                          .sun_error_m = {},
                          .planet_error_m = {},
                          .stiffness_ripple = {}};
  for (int h = 1; h <= mesh_harmonics; ++h) {
    const int teeth = h * rv_20e::sun_teeth;
    mesh.sun_error_m.add_cosine(teeth, d.mesh_profile_um * um / h, h * profile_rad);
    mesh.stiffness_ripple.add_cosine(teeth, mesh_ripple / h, h * profile_rad + 1);
    mesh.sun_error_m.add_cosine(h, d.sun_tooth_error_um * um / h,
                                h * h * phase[phase_of::sun_tooth_error]);
  }
  mesh.planet_error_m.add_cosine(1, d.planet_eccentricity_um * um,
                                 phase[phase_of::planet_eccentricity] + mesh.place_rad);
  if (k == unit.marked_planet) {
    mesh.planet_error_m.add_bump(phase[phase_of::planet_bad_tooth],
                                 two_pi / rv_20e::planet_teeth / 3, -d.planet_bad_tooth_um * um);
  }
  return PlanetMesh(std::move(mesh));
}

CycloidStage cycloid_stage(const RvUnit& unit, int k) {
  const RvDeviations& d = unit.deviations;
  const std::vector<double>& phase = unit.phases_rad;
  CycloidStage::Params stage{.crank = 2 + k,
                             .carrier = 2 + unit.planets,
                             .pins = rv_20e::pins,
                             .stiffness_Nm_rad = rv_20e::torsional_stiffness_Nm_rad / unit.planets,
                             .damping_Nms_rad = cycloid_damping_Nms_rad / unit.planets,
                             .error_rad = {}};
  stage.error_rad.add_cosine(1, d.crank_error_um * um / rv_20e::pin_circle_radius_m,
                             phase[phase_of::crank_error] + two_pi * k / unit.planets);
  stage.error_rad.add_cosine(rv_20e::pins, d.pin_spread_um * um / rv_20e::pin_circle_radius_m,
                             phase[phase_of::pin_spread]);
  return CycloidStage(std::move(stage));
}

Eigen::VectorXd inertias_kg_m2(int planets) {
  const int carrier = 2 + planets;
  Eigen::VectorXd inertia = Eigen::VectorXd::Constant(4 + planets, crank_inertia_kg_m2);
  inertia[0] = motor_inertia_kg_m2;
  inertia[1] = input_shaft_inertia_kg_m2;
  inertia[carrier] = carrier_inertia_kg_m2;
  inertia[carrier + 1] = brake_inertia_kg_m2;
  return inertia;
}

}  // namespace

RvTrain::RvTrain(const RvUnit& unit, double step_s) {
  Terms terms;
  add_input(unit, terms);
  add_stages(unit, terms);
  add_output(unit, terms);
  plant_ = std::make_unique<Plant>(inertias_kg_m2(unit.planets), std::move(terms), step_s);
}

void RvTrain::add_input(const RvUnit& unit, Terms& terms) {
  motor_ = add(terms, InductionMotor({.body = 0,
                                      .pull_out_torque_Nm = pull_out_torque_Nm,
                                      .pull_out_slip = pull_out_slip * unit.motor_slip_factor,
                                      .ripple = torque_ripple}));
  coupling_ = add(terms, ShaftTorsion({.body_a = 0,
                                       .body_b = 1,
                                       .stiffness_Nm_rad = coupling_stiffness_Nm_rad,
                                       .damping_Nms_rad = coupling_damping_Nms_rad}));
  add(terms, Friction({.body = 1,
                       .coulomb_Nm = coulomb_Nm * unit.friction_factor,
                       .viscous_Nms_rad = viscous_Nms_rad * unit.friction_factor,
                       .creep_speed_rad_s = creep_speed_rad_s}));
}

void RvTrain::add_stages(const RvUnit& unit, Terms& terms) {
  for (int k = 0; k < unit.planets; ++k) {
    meshes_.push_back(add(terms, planet_mesh(unit, k)));
    stages_.push_back(add(terms, cycloid_stage(unit, k)));
  }
}

void RvTrain::add_output(const RvUnit& unit, Terms& terms) {
  const int carrier = 2 + unit.planets;
  output_shaft_ = add(terms, ShaftTorsion({.body_a = carrier,
                                           .body_b = carrier + 1,
                                           .stiffness_Nm_rad = output_stiffness_Nm_rad,
                                           .damping_Nms_rad = output_damping_Nms_rad}));
  brake_ = add(terms, Friction({.body = carrier + 1,
                                .viscous_Nms_rad = brake_viscous_Nms_rad,
                                .creep_speed_rad_s = brake_creep_speed_rad_s}));
}

void RvTrain::step() {
  motor_->advance(plant_->step_s());
  plant_->step();
}

void RvTrain::wrap() {
  const Eigen::VectorXd& q = plant_->state().q;
  const Eigen::Index carrier = q.size() - 2;
  if (std::abs(q[carrier]) < two_pi) return;
  const double turns = std::trunc(q[carrier] / two_pi);
  Eigen::VectorXd whole = Eigen::VectorXd::Constant(q.size(), rv_20e::pins);
  whole[0] = whole[1] = rv_20e::gear_ratio;
  whole[carrier] = whole[carrier + 1] = 1;
  plant_->shift(-whole * turns * two_pi);
  wrapped_turns_ += turns;
}

double RvTrain::input_angle_rad() const {
  return state().q[1] + wrapped_turns_ * rv_20e::gear_ratio * two_pi;
}

double RvTrain::crank_angle_rad(std::size_t k) const {
  return state().q[2 + static_cast<Eigen::Index>(k)];
}

double RvTrain::place_rad(std::size_t k) const {
  return carrier_angle_rad() +
         two_pi * static_cast<double>(k) / static_cast<double>(meshes_.size());
}

}  // namespace rvbench::sim
