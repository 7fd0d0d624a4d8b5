#include "sim/terms/housing_mode.hpp"

#include <stdexcept>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

constexpr double within_reach = 0.5;  // of speed over way: three times what the body rings at

// What acts on one body only, as weight does, does not push the frame.
bool pushes_back(const TermSpec& term) {
  const TermType* type = standard_terms().find(term.type);
  return type == nullptr || type->gate.between_two;
}

PlantSpec soften(PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
  const BodySpec* body = plant.find_body(site.body_a);
  if (body == nullptr) {
    throw std::invalid_argument("housing_mode: the plant has no body \"" + site.body_a + '"');
  }
  BodySpec frame;
  frame.name = free_name(plant, "frame");
  frame.motion = body->motion;
  frame.inertia = {parameters.at("mass_ratio").value * body->inertia.value, body->inertia.unit,
                   Quantity::free_pct};
  frame.about = "what " + site.body_a + " stands on";
  bool any = false;
  for (TermSpec& term : plant.terms) {
    if (!term.is_between(site.body_a, housing_name) || !pushes_back(term)) continue;
    term.body_b = frame.name;
    any = true;
  }
  if (!any) {
    throw std::invalid_argument("housing_mode: nothing joins \"" + site.body_a +
                                "\" to the housing");
  }
  hang(plant, frame, housing_name,
       {"housing_mode", parameters.at("frequency").value, parameters.at("damping_ratio").value});
  return plant;
}

}  // namespace

TermType housing_mode() {
  return {
      .card = {.name = "housing_mode",
               .equation = "M·a = F − (2πf)²·M·q − 2ζ·2πf·M·v, F of the body's terms",
               .sign = "f > 0, M > 0",
               .leaves_out = "more than one mode; inputs and sensors stay with the ground",
               .source = "Ewins, Modal Testing, ch. 2.3 (2000)",
               .touches = {{Ledger::fixed_frequency,
                            "all that is near f, at all speeds and loads, in all channels"},
                           {Ledger::transient, "ringing at f"}},
               .must_not_touch = {{Ledger::quasi_static, "forces at constant speed"}},
               .mimics = {"torsional_mode", "sensor_mount", "external_force"},
               .experiment = "hammer on the frame; run-up: 1x of one speed and 3x of a third "
                             "of it meet f alike"},
      .parameters =
          {{.name = "frequency",
            .unit = UnitKind::frequency,
            .min = smallest,
            .max = 1e6,
            .start = within_reach},
           {.name = "damping_ratio", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.02},
           {.name = "mass_ratio", .unit = UnitKind::ratio, .min = 0.01, .max = 1000, .start = 5}},
      .gate = {.rotation = false, .between_two = false, .stands = true},
      .edit = soften};
}

}  // namespace rvbench::sim
