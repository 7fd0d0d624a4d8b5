#include "tests/proof/seal/bench_numbers.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

namespace seal {
namespace {

using nlohmann::json;

const json& named(const json& list, const std::string& name) {
  for (const json& one : list) {
    if (one.value("name", "") == name) return one;
  }
  throw std::invalid_argument("the plant has no " + name);
}

double number(const json& owner, const char* key) {
  return owner.at("parameters").at(key).at("value").get<double>();
}

double number_or_0(const json& owner, const char* key) {
  return owner.at("parameters").contains(key) ? number(owner, key) : 0;
}

BenchNumbers::Mesh mesh_of(const json& term) {
  return {number(term, "place"),
          number(term, "stiffness"),
          number(term, "damping"),
          number_or_0(term, "stiffness_ripple"),
          number_or_0(term, "stiffness_ripple_phase"),
          number_or_0(term, "profile_error"),
          number_or_0(term, "profile_phase")};
}

// Each number of a plant that has a tolerance: see(quantity, tolerance as a share).
void for_each_built(json& plant, const std::function<void(json&, double)>& see) {
  const auto look = [&](json& quantity) {
    const auto tolerance = quantity.find("tolerance_pct");
    if (tolerance == quantity.end() || !tolerance->is_number()) return;
    see(quantity, tolerance->get<double>() / 100);
  };
  for (json& body : plant.at("bodies")) {
    for (auto& [key, value] : body.items()) {
      if (value.is_object()) look(value);
    }
  }
  for (json& term : plant.at("terms")) {
    for (auto& [key, quantity] : term.at("parameters").items()) look(quantity);
  }
}

void scale(json& quantity, double by) {
  quantity["value"] = quantity.at("value").get<double>() * by;
}

}  // namespace

BenchNumbers numbers_of(const json& plant) {
  const json& bodies = plant.at("bodies");
  const auto inertia = [&](const char* body) {
    return named(bodies, body).at("inertia").at("value").get<double>();
  };
  const auto term = [&](const char* name) -> const json& { return named(plant.at("terms"), name); };
  const auto stage = [&](const char* name) {
    return BenchNumbers::Stage{number(term(name), "stiffness"), number(term(name), "damping")};
  };
  return {.motor_inertia = inertia("motor"),
          .sun_inertia = inertia("input_shaft"),
          .carrier_inertia = inertia("carrier"),
          .brake_inertia = inertia("brake"),
          .planet_inertia = {inertia("planet_1"), inertia("planet_2")},
          .pull_out_torque_Nm = number(term("motor_torque"), "pull_out_torque"),
          .pull_out_slip = number(term("motor_torque"), "pull_out_slip"),
          .motor_ripple = number_or_0(term("motor_torque"), "ripple"),
          .coupling_stiffness = number(term("coupling"), "stiffness"),
          .coupling_damping = number(term("coupling"), "damping"),
          .sun_friction_Nm = number(term("shaft_friction"), "level"),
          .creep_rad_s = number(term("shaft_friction"), "creep_speed"),
          .sun_drag = number(term("shaft_drag"), "damping"),
          .brake_drag = number(term("brake_drag"), "damping"),
          .sun_radius_m = number(term("mesh_1"), "sun_base_radius"),
          .planet_radius_m = number(term("mesh_1"), "planet_base_radius"),
          .sun_teeth = number(term("mesh_1"), "sun_teeth"),
          .mesh = {mesh_of(term("mesh_1")), mesh_of(term("mesh_2"))},
          .pins = number(term("stage_1"), "pins"),
          .pin_circle_m = number(term("stage_1"), "pin_circle_radius"),
          .stage = {stage("stage_1"), stage("stage_2")},
          .output_stiffness = number(term("output_shaft"), "stiffness"),
          .output_damping = number(term("output_shaft"), "damping")};
}

json as_built(json plant, Draw& draw) {
  for_each_built(plant, [&](json& quantity, double tolerance) {
    scale(quantity, 1 + tolerance * draw.uniform(-1, 1));
  });
  return plant;
}

std::vector<json> each_off(const json& plant) {
  std::size_t count = 0;
  json counted = plant;
  for_each_built(counted, [&](json&, double) { ++count; });
  std::vector<json> machines(count, plant);
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t number = 0;
    for_each_built(machines[i], [&](json& quantity, double tolerance) {
      if (number++ == i) scale(quantity, 1 + tolerance / std::sqrt(3.0));  // evenly within
    });
  }
  return machines;
}

}  // namespace seal
