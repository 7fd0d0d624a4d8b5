#include "sim/plant_spec.hpp"

#include "sim/named.hpp"

namespace rvbench::sim {

const BodySpec* PlantSpec::find_body(std::string_view body) const {
  return find_named(bodies, body);
}
const TermSpec* PlantSpec::find_term(std::string_view term) const {
  return find_named(terms, term);
}
const InputSpec* PlantSpec::find_input(std::string_view input) const {
  return find_named(inputs, input);
}

Motion PlantSpec::motion_of(std::string_view body_or_term) const {
  const TermSpec* term = find_term(body_or_term);
  const BodySpec* body = find_body(term == nullptr ? body_or_term : term->body_a);
  return body == nullptr ? Motion::translation : body->motion;
}

std::vector<PlacedQuantity> quantities(PlantSpec& plant) {
  std::vector<PlacedQuantity> all;
  const auto add = [&all](const std::string& list, std::size_t i, const std::string& key,
                          Quantity& quantity) {
    all.push_back({"/" + list + "/" + std::to_string(i) + "/" + key, &quantity});
  };
  for (std::size_t i = 0; i < plant.bodies.size(); ++i) {
    BodySpec& body = plant.bodies[i];
    add("bodies", i, body.motion == Motion::rotation ? "inertia" : "mass", body.inertia);
  }
  for (std::size_t i = 0; i < plant.terms.size(); ++i) {
    for (auto& [name, quantity] : plant.terms[i].parameters) {
      add("terms", i, "parameters/" + name, quantity);
    }
  }
  for (std::size_t i = 0; i < plant.inputs.size(); ++i) {
    add("inputs", i, "gain", plant.inputs[i].gain);
    add("inputs", i, "offset", plant.inputs[i].offset);
  }
  for (std::size_t i = 0; i < plant.outputs.size(); ++i) {
    add("outputs", i, "gain", plant.outputs[i].gain);
    add("outputs", i, "offset", plant.outputs[i].offset);
    add("outputs", i, "delay", plant.outputs[i].delay);
  }
  return all;
}

std::string_view si_unit(InputKind kind, Motion motion) {
  switch (kind) {
    case InputKind::force: return unit_of(UnitKind::force, motion);
    case InputKind::signal: return "";
    case InputKind::position: return unit_of(UnitKind::coordinate, motion);
    case InputKind::speed: return unit_of(UnitKind::speed, motion);
    case InputKind::acceleration: return unit_of(UnitKind::acceleration, motion);
  }
  return {};
}

std::string_view si_unit(OutputKind kind, Motion motion) {
  switch (kind) {
    case OutputKind::position: return unit_of(UnitKind::coordinate, motion);
    case OutputKind::speed: return unit_of(UnitKind::speed, motion);
    case OutputKind::acceleration: return unit_of(UnitKind::acceleration, motion);
    case OutputKind::effort:
    case OutputKind::drive: return unit_of(UnitKind::force, motion);
  }
  return {};
}

}  // namespace rvbench::sim
