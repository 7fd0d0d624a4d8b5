#include "sim/effect_edits.hpp"

#include <algorithm>
#include <stdexcept>

#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

TermSpec& term_of(PlantSpec& plant, const std::string& effect, const std::string& name) {
  for (TermSpec& term : plant.terms) {
    if (term.name == name) return term;
  }
  throw std::invalid_argument(effect + ": the plant has no term \"" + name + '"');
}

struct SpringAndDamper {
  std::string effect;  // names its terms
  double stiffness = 0;
  double damping = 0;
};

void join(PlantSpec& plant, const std::string& body_a, const std::string& body_b,
          const SpringAndDamper& by) {
  const Motion motion = plant.motion_of(body_a);
  const auto add = [&](const std::string& type, const char* parameter, double value,
                       UnitKind kind) {
    TermSpec term;
    term.name = free_name(plant, by.effect + '_' + type);
    term.type = type;
    term.body_a = body_a;
    term.body_b = body_b;
    term.parameters[parameter] = {value, std::string(unit_of(kind, motion)), Quantity::free_pct};
    plant.terms.push_back(std::move(term));
  };
  add("spring", "stiffness", by.stiffness, UnitKind::stiffness);
  add("damper", "damping", by.damping, UnitKind::damping);
}

}  // namespace

std::string free_name(const PlantSpec& plant, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2; plant.find_body(name) != nullptr || plant.find_term(name) != nullptr; ++i) {
    name = wanted + '_' + std::to_string(i);
  }
  return name;
}

std::vector<std::string> holding(const PlantSpec& plant, std::string_view body,
                                 const TermLibrary& library) {
  std::vector<std::string> names;
  for (const TermSpec& term : plant.terms) {
    const TermType* type = library.find(term.type);
    const bool pushes_back = type != nullptr && type->gate.between_two;
    if (pushes_back && term.is_between(body, housing_name)) names.push_back(term.name);
  }
  return names;
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
  join(plant, site.body_a, far.name, {split.effect, split.stiffness, split.damping});
  return plant;
}

void hang(PlantSpec& plant, const BodySpec& body, std::string_view on, const Resonance& resonance) {
  const double omega_rad_s = units::two_pi * resonance.frequency_Hz;
  plant.bodies.push_back(body);
  join(plant, body.name, std::string(on),
       {resonance.effect, omega_rad_s * omega_rad_s * body.inertia.value,
        2 * resonance.damping_ratio * omega_rad_s * body.inertia.value});
}

ParameterCard resonance_card(double start) {
  return {.name = "frequency",
          .unit = UnitKind::frequency,
          .min = smallest,
          .max = 1e6,
          .start = start};
}

ParameterCard damping_ratio_card(double start, double min) {
  return {.name = "damping_ratio",
          .unit = UnitKind::ratio,
          .min = min,
          .max = 1,
          .start = start,
          .same_law = true};
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
