#include <cmath>
#include <nlohmann/json.hpp>

#include "hal/json_object.hpp"
#include "sim/plant_json.hpp"
#include "sim/plant_words.hpp"

namespace rvbench::sim {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Quantity& quantity) {
  ordered_json json = hal::json_object({{"value", quantity.value}, {"unit", quantity.unit}});
  if (std::isinf(quantity.tolerance_pct)) {
    json["tolerance_pct"] = "free";
  } else {
    json["tolerance_pct"] = quantity.tolerance_pct;
  }
  return json;
}

ordered_json json_of(const BodySpec& body) {
  const bool turns = body.motion == Motion::rotation;
  return {{"name", body.name},
          {"motion", word_of(motion_words, body.motion)},
          {turns ? "inertia" : "mass", json_of(body.inertia)},
          {turns ? "start_angle_rad" : "start_position_m", body.start_position},
          {turns ? "start_speed_rad_s" : "start_speed_m_s", body.start_speed},
          {"about", body.about}};
}

ordered_json json_of(const TermSpec& term, const TermLibrary& library) {
  ordered_json json = hal::json_object(
      {{"name", term.name}, {"type", term.type}, {"body_a", term.body_a}, {"body_b", term.body_b}});
  const TermType* type = library.find(term.type);
  if (type != nullptr && type->gate.reference != ReferenceKind::none) {
    json[type->gate.reference_key] = term.reference;
  }
  json["parameters"] = ordered_json::object();
  for (const auto& [name, quantity] : term.parameters) json["parameters"][name] = json_of(quantity);
  json["about"] = term.about;
  return json;
}

ordered_json json_of(const InputSpec& input) {
  ordered_json json = hal::json_object({{"name", input.name},
                                        {"channel", input.channel},
                                        {"unit", input.unit},
                                        {"is", word_of(input_words, input.kind)}});
  if (input.kind != InputKind::signal) json["body"] = input.body;
  json["gain"] = json_of(input.gain);
  json["offset"] = json_of(input.offset);
  if (input.kind < InputKind::position) {
    json["between_samples"] = word_of(between_words, input.between);
  } else {
    json["band_Hz"] = input.band_Hz;
  }
  return json;
}

ordered_json json_of(const Hum& hum) {
  return hal::json_object({{"amplitude", json_of(hum.amplitude)},
                           {"phase", json_of(hum.phase)},
                           {"frequency", json_of(hum.frequency)}});
}

ordered_json json_of(const OutputSpec& output) {
  ordered_json json{{"channel", output.channel},
                    {"unit", output.unit},
                    {"is", word_of(output_words, output.kind)},
                    {output.kind == OutputKind::effort ? "term" : "body", output.of},
                    {"gain", json_of(output.gain)},
                    {"offset", json_of(output.offset)},
                    {"delay", json_of(output.delay)},
                    {"compared_by", word_of(compared_by_words, output.compared_by)}};
  if (output.compared_by == ComparedBy::envelope) {
    json["from_Hz"] = output.from_Hz;
    json["to_Hz"] = output.to_Hz;
  }
  for (const Hum& hum : output.hums) json["hums"].push_back(json_of(hum));
  return json;
}

}  // namespace

std::string write_plant(const PlantSpec& plant, const TermLibrary& library) {
  ordered_json json = hal::json_object({{"plant", plant.name}, {"about", plant.about}});
  for (const char* list : {"bodies", "terms", "inputs", "outputs"}) {
    json[list] = ordered_json::array();
  }
  for (const BodySpec& body : plant.bodies) json["bodies"].push_back(json_of(body));
  for (const TermSpec& term : plant.terms) json["terms"].push_back(json_of(term, library));
  for (const InputSpec& input : plant.inputs) json["inputs"].push_back(json_of(input));
  for (const OutputSpec& output : plant.outputs) json["outputs"].push_back(json_of(output));
  return json.dump(2) + '\n';
}

}  // namespace rvbench::sim
