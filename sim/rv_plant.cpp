#include "sim/rv_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "hal/did_you_mean.hpp"
#include "sim/named.hpp"
#include "sim/plant_json.hpp"
#include "sim/plant_model.hpp"

namespace rvbench::sim {
namespace {

using hal::in_quotes;
using Faults = std::vector<hal::ConfigFault>;

// Of those steps that keep a swing's time, in one of the bench. At twelve a mode turns by half a
// period in a step, and what it echoes slows the motor by a sixth.
constexpr double coarsest_step = 10;

// Friction of the input shaft, in the shipped plant: what wears and warms up.
constexpr std::string_view shaft_friction = "shaft_friction", shaft_drag = "shaft_drag";

void check_bodies(const PlantSpec& plant, Faults& faults) {
  for (const std::string_view body :
       {rv_parts::motor, rv_parts::input_shaft, rv_parts::carrier, rv_parts::brake}) {
    if (plant.find_body(body) != nullptr) continue;
    faults.push_back({0, "/bodies", "the bench needs a body called " + in_quotes(body)});
  }
}

// Whether the brake's torque is what a holding brake is told.
bool is_told(const PlantSpec& plant) {
  const InputSpec* told = plant.find_input(rv_parts::brake_torque);
  return told != nullptr && told->kind == InputKind::signal && told->unit == "N·m" &&
         std::ranges::any_of(plant.terms, [](const TermSpec& term) {
           return term.type == "holding_brake" && term.body_a == rv_parts::brake &&
                  term.reference == rv_parts::brake_torque;
         });
}

void check_inputs(const PlantSpec& plant, Faults& faults) {
  const InputSpec* supply = plant.find_input(rv_parts::supply);
  if (supply == nullptr || supply->kind != InputKind::signal || supply->unit != "Hz") {
    faults.push_back({0, "/inputs", "the bench needs a signal called \"supply\" in Hz"});
  }
  const InputSpec* brake = plant.find_input(rv_parts::brake_torque);
  const bool pushes = brake != nullptr && brake->kind == InputKind::force;
  if (!(pushes && brake->body == rv_parts::brake) && !is_told(plant)) {
    faults.push_back({0, "/inputs",
                      "the bench needs a force called \"brake_torque\" on the body \"brake\", or a "
                      "signal of that name that a holding_brake on it is told"});
  }
  for (std::size_t i = 0; i < plant.inputs.size(); ++i) {
    if (&plant.inputs[i] == supply || &plant.inputs[i] == brake) continue;
    faults.push_back({0, "/inputs/" + std::to_string(i), "the bench has nothing to drive it with"});
  }
}

void check_terms(const PlantSpec& plant, Faults& faults) {
  const auto need = [&](const std::string& what, const auto& is_it) {
    if (std::ranges::none_of(plant.terms, is_it)) {
      faults.push_back({0, "/terms", "the bench needs " + what});
    }
  };
  need("an induction_motor on \"motor\"", [](const TermSpec& t) {
    return t.type == "induction_motor" && t.body_a == rv_parts::motor;
  });
  need("a term between \"motor\" and \"input_shaft\"",
       [](const TermSpec& t) { return t.is_between(rv_parts::motor, rv_parts::input_shaft); });
  need("a term between \"carrier\" and \"brake\"",
       [](const TermSpec& t) { return t.is_between(rv_parts::carrier, rv_parts::brake); });
  need("a planet_mesh", [](const TermSpec& t) { return t.type == "planet_mesh"; });
  for (const TermSpec& mesh : plant.terms) {
    if (mesh.type != "planet_mesh") continue;
    need("a cycloid_stage of " + in_quotes(mesh.body_b),
         [&](const TermSpec& t) { return t.type == "cycloid_stage" && t.body_a == mesh.body_b; });
  }
}

// What the plant leaves at 0 is drawn.
void deviate(TermSpec& term, const char* error, double size, const char* phase, double phase_rad) {
  Quantity& deviation = term.parameters.at(error);
  if (deviation.value != 0) return;
  deviation.value = size;
  term.parameters.at(phase).value = phase_rad;
}

void deviate_mesh(TermSpec& mesh, const RvUnit& unit, bool marked) {
  const RvDeviations& d = unit.deviations;
  const std::vector<double>& phase = unit.phases_rad;
  deviate(mesh, "profile_error", d.mesh_profile_um * um, "profile_phase",
          phase[phase_of::mesh_profile]);
  deviate(mesh, "sun_tooth_error", d.sun_tooth_error_um * um, "sun_tooth_phase",
          phase[phase_of::sun_tooth_error]);
  deviate(mesh, "planet_eccentricity", d.planet_eccentricity_um * um, "planet_eccentricity_phase",
          phase[phase_of::planet_eccentricity] + mesh.parameters.at("place").value);
  if (!marked) return;
  deviate(mesh, "lost_flank", d.planet_bad_tooth_um * um, "lost_flank_place",
          phase[phase_of::planet_bad_tooth]);
}

void deviate_stage(TermSpec& stage, const RvUnit& unit, double place_rad) {
  const RvDeviations& d = unit.deviations;
  deviate(stage, "crank_error", d.crank_error_um * um, "crank_phase",
          unit.phases_rad[phase_of::crank_error] + place_rad);
  deviate(stage, "pin_error", d.pin_spread_um * um, "pin_phase",
          unit.phases_rad[phase_of::pin_spread]);
}

void scale(PlantSpec& plant, std::string_view name, const char* parameter, double factor) {
  for (TermSpec& term : plant.terms) {
    const auto found = term.parameters.find(parameter);
    if (term.name == name && found != term.parameters.end()) found->second.value *= factor;
  }
}

}  // namespace

const PlantSpec& rv20e_bench() {
  static const PlantSpec plant = std::get<PlantSpec>(read_plant("rv20e_bench"));
  return plant;
}

std::vector<hal::ConfigFault> rv_plant_faults(const PlantSpec& plant, double step_rate_Hz) {
  Faults faults;
  check_bodies(plant, faults);
  check_inputs(plant, faults);
  check_terms(plant, faults);
  if (!faults.empty()) return faults;
  const auto made = make_model(plant);
  if (const auto* fault = std::get_if<hal::ConfigFault>(&made)) {
    faults.push_back(*fault);
  } else if (substeps_wanted(std::get<PlantModel>(made), step_rate_Hz) > coarsest_step) {
    faults.push_back({0, "/terms",
                      fmt::format("a mode is too fast for the bench, which takes {:g} steps a "
                                  "second: less stiffness, or more inertia beside it",
                                  step_rate_Hz)});
  }
  return faults;
}

PlantSpec with_holding_brake(PlantSpec plant) {
  if (is_told(plant)) return plant;
  for (InputSpec& input : plant.inputs) {
    if (input.name != rv_parts::brake_torque) continue;
    input.kind = InputKind::signal;
    input.body.clear();
    input.gain = {1, "1"};
  }
  // Under rated torque it would take an hour to creep by an arc minute.
  plant.terms.push_back({.name = "holding_brake",
                         .type = "holding_brake",
                         .body_a = std::string(rv_parts::brake),
                         .reference = std::string(rv_parts::brake_torque),
                         .parameters = {{"creep_speed", {1e-7, "rad/s"}}}});
  return plant;
}

PlantSpec as_built(PlantSpec plant, const RvUnit& unit) {
  int planet = 0;
  for (TermSpec& mesh : plant.terms) {
    if (mesh.type != "planet_mesh") continue;
    deviate_mesh(mesh, unit, planet++ == unit.marked_planet);
    for (TermSpec& stage : plant.terms) {
      if (stage.type != "cycloid_stage" || stage.body_a != mesh.body_b) continue;
      deviate_stage(stage, unit, mesh.parameters.at("place").value);
    }
  }
  scale(plant, shaft_friction, "level", unit.friction_factor);
  scale(plant, shaft_drag, "damping", unit.friction_factor);
  for (TermSpec& term : plant.terms) {
    if (term.type == "induction_motor") {
      term.parameters.at("pull_out_slip").value *= unit.motor_slip_factor;
    }
  }
  return plant;
}

}  // namespace rvbench::sim
