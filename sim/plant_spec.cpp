#include "sim/plant_spec.hpp"

#include <algorithm>

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
const OutputSpec* PlantSpec::find_output(std::string_view channel) const {
  const auto found = std::ranges::find(outputs, channel, &OutputSpec::channel);
  return found == outputs.end() ? nullptr : &*found;
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
    std::vector<Hum>& hums = plant.outputs[i].hums;
    for (std::size_t h = 0; h < hums.size(); ++h) {
      const std::string hum = "hums/" + std::to_string(h) + "/";
      add("outputs", i, hum + "amplitude", hums[h].amplitude);
      add("outputs", i, hum + "phase", hums[h].phase);
      add("outputs", i, hum + "frequency", hums[h].frequency);
    }
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

UnitKind unit_kind(OutputKind kind) {
  switch (kind) {
    case OutputKind::position: return UnitKind::coordinate;
    case OutputKind::speed: return UnitKind::speed;
    case OutputKind::acceleration: return UnitKind::acceleration;
    case OutputKind::effort:
    case OutputKind::drive: break;
  }
  return UnitKind::force;
}

std::string_view si_unit(OutputKind kind, Motion motion) {
  return unit_of(unit_kind(kind), motion);
}

}  // namespace rvbench::sim
