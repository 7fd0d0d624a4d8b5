#pragma once

#include <catch2/catch.hpp>
#include <numbers>

#include "sim/named.hpp"
#include "sim/plant.hpp"
#include "sim/rv_plant.hpp"
#include "sim/term_library.hpp"
#include "sim/terms/dry_friction.hpp"

namespace rvbench::test {

/// How an RV-20E train differs from the drawing, plants/rv20e_bench.json.
struct RvTrainSpec {
  double step_s = 5e-5;
  double supply_Hz = 0;    ///< 0: the motor is not switched on
  double profile_m = 0;    ///< on each tooth of the sun, and falling harmonics of it
  double mesh_ripple = 0;  ///< of the stiffness, relative, likewise
  double crank_error_m = 0;
  double pin_ripple_m = 0;
  double bearing_coulomb_Nm = 0.15;
  double brake_coulomb_Nm = 0;
  double damping_factor = 1;
};

inline sim::PlantSpec rv_plant(const RvTrainSpec& spec) {
  sim::PlantSpec plant = sim::rv20e_bench();
  for (sim::TermSpec& term : plant.terms) {
    const auto set = [&](const char* parameter, double value) {
      term.parameters.at(parameter).value = value;
    };
    if (term.type == "induction_motor") set("ripple", 0);
    if (term.type == "planet_mesh") {
      set("profile_error", spec.profile_m);
      set("profile_phase", 0.5);
      set("stiffness_ripple", spec.mesh_ripple);
    }
    if (term.type == "cycloid_stage") {
      set("crank_error", spec.crank_error_m);
      set("crank_phase", 0.2);
      set("pin_error", spec.pin_ripple_m);
    }
    if (term.name == "shaft_friction") set("level", spec.bearing_coulomb_Nm);
    for (auto& [name, quantity] : term.parameters) {
      if (name == "damping" && term.type != "viscous_friction") {
        quantity.value *= spec.damping_factor;
      }
    }
  }
  if (spec.supply_Hz == 0) {
    std::erase_if(plant.terms, [](const auto& term) { return term.type == "induction_motor"; });
  }
  return plant;
}

/// A plant of the bench on the stepper of the simulated rig, its brake dry friction.
class SteppedTrain {
 public:
  SteppedTrain(const sim::PlantSpec& plant, double supply_Hz, double brake_Nm,
               double step_s = 1.0 / 19840)
      : plant_(std::get<sim::PlantModel>(sim::make_model(plant)), step_s),
        brake_Nm_(brake_Nm),
        brake_(sim::index_of(plant.bodies, sim::rv_parts::brake)) {
    plant_.set_input(0, supply_Hz);
  }
  explicit SteppedTrain(const RvTrainSpec& spec)
      : SteppedTrain(rv_plant(spec), spec.supply_Hz, spec.brake_coulomb_Nm, spec.step_s) {}

  void step() {
    plant_.set_input(1, brake_Nm_ * sim::creeping_sign(plant_.state().v[brake_], 0.05));
    plant_.step();
  }
  sim::Plant& plant() { return plant_; }
  const sim::Plant& plant() const { return plant_; }

 private:
  sim::Plant plant_;
  double brake_Nm_;
  int brake_;
};

}  // namespace rvbench::test
