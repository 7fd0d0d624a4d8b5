#include "sim/terms/sensor_mount.hpp"

#include <stdexcept>
#include <utility>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

constexpr double part_of_body = 1e-6;    // splits a resonance that the mount meets by 1e-3
constexpr double least_damping = 0.005;  // less would load the body there
constexpr double lightest_part = 1e-3;   // of a body's mass: what is no part of the machine

PlantSpec loosen(PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
  OutputSpec& output = output_of(plant, "sensor_mount", site.channel);
  const BodySpec* body = plant.find_body(output.of);
  if (body == nullptr || output.kind > OutputKind::acceleration) {
    throw std::invalid_argument("sensor_mount: \"" + site.channel + "\" is no motion of a body");
  }
  BodySpec mount = *body;
  mount.name = free_name(plant, "sensor_mount");
  mount.inertia = {part_of_body * body->inertia.value, body->inertia.unit, 0};
  mount.about = "the sensor of " + site.channel;
  const std::string on = std::exchange(output.of, mount.name);
  hang(plant, mount, on,
       {"sensor_mount", parameters.at("frequency").value, parameters.at("damping_ratio").value});
  return plant;
}

// A body of a thousandth or less of the one other body that it hangs on.
bool is_mount(const PlantSpec& plant, const BodySpec& body) {
  std::string_view on;
  for (const TermSpec& term : plant.terms) {
    if (term.body_a != body.name && term.body_b != body.name) continue;
    const std::string& other = term.body_a == body.name ? term.body_b : term.body_a;
    if (!on.empty() && other != on) return false;
    on = other;
  }
  const BodySpec* carrier = plant.find_body(on);
  return carrier != nullptr && body.inertia.value <= lightest_part * carrier->inertia.value;
}

// By this effect or by the plant file.
bool sits_on_mount(const PlantSpec& plant, const OutputSpec& output) {
  const BodySpec* body = plant.find_body(output.of);
  return body != nullptr && is_mount(plant, *body);
}

}  // namespace

TermType sensor_mount() {
  return {
      .card = {.name = "sensor_mount",
               .equation = "shown/moved = (1 + 2jζr)/(1 − r² + 2jζr), r = frequency/f",
               .sign = "f > 0",
               .leaves_out = "what the sensor's mass does to the body, tilt, more than one mode",
               .source = "ISO 5348 (2021); Rao, Mechanical Vibrations, ch. 3.6",
               .touches = {{Ledger::fixed_frequency,
                            "one channel: all that is near f, at all speeds and loads"},
                           {Ledger::broadband, "one channel: a hump at f"}},
               .must_not_touch = {{Ledger::fixed_frequency, "any other channel of the body"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"housing_mode", "torsional_mode", "looseness"},
               .experiment = "swap the sensors: it stays with the mount; glue it: f rises"},
      .parameters = {resonance_card(within_reach), damping_ratio_card(0.03, least_damping)},
      .gate = {.rotation = false, .in_channel = InChannel::of_a_motion, .is_in = sits_on_mount},
      .edit = loosen};
}

}  // namespace rvbench::sim
