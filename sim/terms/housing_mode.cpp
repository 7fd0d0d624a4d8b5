#include "sim/terms/housing_mode.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

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
  if (site.beyond.empty()) {
    throw std::invalid_argument("housing_mode: nothing holds \"" + site.body_a +
                                "\" on the housing");
  }
  for (TermSpec& term : plant.terms) {
    if (std::ranges::find(site.beyond, term.name) == site.beyond.end()) continue;
    (term.body_a == housing_name ? term.body_a : term.body_b) = frame.name;
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
          {resonance_card(within_reach),
           damping_ratio_card(0.02),
           {.name = "mass_ratio", .unit = UnitKind::ratio, .min = 0.01, .max = 1000, .start = 5}},
      .gate = {.rotation = false, .between_two = false, .stands = true},
      .edit = soften};
}

}  // namespace rvbench::sim
