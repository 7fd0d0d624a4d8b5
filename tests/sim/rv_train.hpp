#pragma once

#include <memory>
#include <numbers>
#include <vector>

#include "sim/plant.hpp"
#include "sim/terms/cycloid_stage.hpp"
#include "sim/terms/friction.hpp"
#include "sim/terms/induction_motor.hpp"
#include "sim/terms/planet_mesh.hpp"
#include "sim/terms/shaft_torsion.hpp"

namespace rvbench::test {

/// An RV-20E train: motor, sun, planets, carrier, brake.
struct RvTrainSpec {
  int planets = 2;
  double step_s = 5e-5;
  double supply_Hz = 0;  ///< 0: no motor
  double motor_inertia = 2e-3;
  double profile_m = 0;    ///< on each tooth of the sun
  double mesh_ripple = 0;  ///< of the stiffness, relative
  double crank_error_rad = 0;
  double pin_ripple_rad = 0;
  double bearing_coulomb_Nm = 0.15;
  double brake_coulomb_Nm = 0;
  double damping_factor = 1;
};

struct RvTrain {
  std::unique_ptr<sim::Plant> plant;
  std::vector<const sim::PlanetMesh*> meshes;
  int sun = 1, first_planet = 2, carrier = 0, brake = 0;
};

inline sim::InductionMotor motor_of(const RvTrainSpec& spec) {
  sim::InductionMotor motor({.pull_out_torque_Nm = 12, .pull_out_slip = 0.15});
  motor.set_supply(spec.supply_Hz, true);
  return motor;
}

inline sim::PlanetMesh planet_of(const RvTrainSpec& spec, int k) {
  sim::PlanetMesh::Params mesh{.sun = 1,
                               .carrier = 2 + spec.planets,
                               .planet = 2 + k,
                               .place_rad = 2 * std::numbers::pi * k / spec.planets,
                               .sun_base_radius_m = 5e-3,
                               .planet_base_radius_m = 15e-3,
                               .stiffness_N_m = 8e7,
                               .damping_Ns_m = 1000 * spec.damping_factor,
                               .sun_error_m = {},
                               .planet_error_m = {},
                               .stiffness_ripple = {}};
  mesh.sun_error_m.add_cosine(9, spec.profile_m, 0.5);
  mesh.stiffness_ripple.add_cosine(9, spec.mesh_ripple, 1);
  return sim::PlanetMesh(std::move(mesh));
}

inline sim::CycloidStage crank_of(const RvTrainSpec& spec, int k) {
  sim::CycloidStage::Params stage{.crank = 2 + k,
                                  .carrier = 2 + spec.planets,
                                  .pins = 40,
                                  .stiffness_Nm_rad = 168e3 / spec.planets,
                                  .damping_Nms_rad = 80 * spec.damping_factor / spec.planets,
                                  .error_rad = {}};
  stage.error_rad.add_cosine(1, spec.crank_error_rad, 0.2);
  stage.error_rad.add_cosine(40, spec.pin_ripple_rad, 0);
  return sim::CycloidStage(std::move(stage));
}

inline RvTrain make_rv_train(const RvTrainSpec& spec) {
  RvTrain train;
  train.carrier = 2 + spec.planets;
  train.brake = train.carrier + 1;
  std::vector<std::unique_ptr<sim::PhysicsTerm>> terms;
  const auto add = [&terms](auto term) {
    terms.push_back(std::make_unique<decltype(term)>(std::move(term)));
  };
  if (spec.supply_Hz > 0) add(motor_of(spec));
  add(sim::ShaftTorsion({.body_a = 0,
                         .body_b = 1,
                         .stiffness_Nm_rad = 600,
                         .damping_Nms_rad = 0.05 * spec.damping_factor}));
  add(sim::Friction({.body = 1,
                     .coulomb_Nm = spec.bearing_coulomb_Nm,
                     .viscous_Nms_rad = 5e-4,
                     .creep_speed_rad_s = 2}));
  for (int k = 0; k < spec.planets; ++k) {
    auto mesh = std::make_unique<sim::PlanetMesh>(planet_of(spec, k));
    train.meshes.push_back(mesh.get());
    terms.push_back(std::move(mesh));
    add(crank_of(spec, k));
  }
  add(sim::ShaftTorsion({.body_a = train.carrier,
                         .body_b = train.brake,
                         .stiffness_Nm_rad = 6e4,
                         .damping_Nms_rad = 20 * spec.damping_factor}));
  add(sim::Friction({.body = train.brake,
                     .coulomb_Nm = spec.brake_coulomb_Nm,
                     .viscous_Nms_rad = 0.5,
                     .creep_speed_rad_s = 0.05}));
  Eigen::VectorXd inertia = Eigen::VectorXd::Constant(4 + spec.planets, 2e-5);
  inertia[0] = spec.motor_inertia;
  inertia[1] = 5e-5;
  inertia[train.carrier] = 0.03;
  inertia[train.brake] = 0.3;
  train.plant = std::make_unique<sim::Plant>(inertia, std::move(terms), spec.step_s);
  return train;
}

}  // namespace rvbench::test
