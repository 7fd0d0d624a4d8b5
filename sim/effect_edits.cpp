#include "sim/effect_edits.hpp"

#include <algorithm>
#include <stdexcept>

namespace rvbench::sim {
namespace {

TermSpec& term_of(PlantSpec& plant, const std::string& effect, const std::string& name) {
  for (TermSpec& term : plant.terms) {
    if (term.name == name) return term;
  }
  throw std::invalid_argument(effect + ": the plant has no term \"" + name + '"');
}

TermSpec between(const PlantSpec& plant, const std::string& type, const BodySplit& split,
                 const std::string& near, const std::string& far) {
  const Motion motion = plant.motion_of(near);
  const bool is_spring = type == "spring";
  const UnitKind unit = is_spring ? UnitKind::stiffness : UnitKind::damping;
  TermSpec term;
  term.name = free_name(plant, split.effect + '_' + type);
  term.type = type;
  term.body_a = near;
  term.body_b = far;
  term.parameters[is_spring ? "stiffness" : "damping"] = {
      is_spring ? split.stiffness : split.damping, std::string(unit_of(unit, motion)),
      Quantity::free_pct};
  return term;
}

}  // namespace

std::string free_name(const PlantSpec& plant, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2; plant.find_body(name) != nullptr || plant.find_term(name) != nullptr; ++i) {
    name = wanted + '_' + std::to_string(i);
  }
  return name;
}

PlantSpec replace_or_append(PlantSpec plant, const std::string& type, const EffectSite& site,
                            const Parameters& parameters) {
  if (site.reference.empty()) {
    plant.terms.push_back({free_name(plant, type), type, site.body_a, site.body_b, "", parameters});
    return plant;
  }
  TermSpec& term = term_of(plant, type, site.reference);
  term.type = type;
  term.parameters.insert(parameters.begin(), parameters.end());
  return plant;
}

PlantSpec split_body(PlantSpec plant, const EffectSite& site, const BodySplit& split) {
  const auto body = std::find_if(plant.bodies.begin(), plant.bodies.end(),
                                 [&](const BodySpec& b) { return b.name == site.body_a; });
  if (body == plant.bodies.end()) {
    throw std::invalid_argument(split.effect + ": the plant has no body \"" + site.body_a + '"');
  }
  if (!(split.share > 0 && split.share < 1)) {
    throw std::invalid_argument(split.effect + ": the share must be within (0, 1)");
  }
  BodySpec far = *body;
  far.name = free_name(plant, split.effect + "_far");
  far.inertia.value *= split.share;
  body->inertia.value -= far.inertia.value;
  for (const std::string& name : site.beyond) {
    TermSpec& term = term_of(plant, split.effect, name);
    if (term.body_a == site.body_a) term.body_a = far.name;
    if (term.body_b == site.body_a) term.body_b = far.name;
  }
  plant.bodies.push_back(far);
  plant.terms.push_back(between(plant, "spring", split, site.body_a, far.name));
  plant.terms.push_back(between(plant, "damper", split, site.body_a, far.name));
  return plant;
}

OutputSpec& output_of(PlantSpec& plant, const std::string& effect, const std::string& channel) {
  const auto output = std::ranges::find(plant.outputs, channel, &OutputSpec::channel);
  if (output == plant.outputs.end()) {
    throw std::invalid_argument(effect + ": the plant has no output \"" + channel + '"');
  }
  return *output;
}

PlantSpec with_probes(PlantSpec plant, const std::string& body,
                      const std::vector<OutputKind>& kinds) {
  plant.outputs.clear();
  for (const OutputKind kind : kinds) {
    OutputSpec output;
    output.kind = kind;
    output.of = body;
    output.unit = std::string(si_unit(kind, plant.motion_of(body)));
    output.channel = "probe " + std::to_string(plant.outputs.size());
    output.gain = {1, "1"};
    output.offset = {0, output.unit};
    output.delay = {0, "s"};
    plant.outputs.push_back(std::move(output));
  }
  return plant;
}

}  // namespace rvbench::sim
