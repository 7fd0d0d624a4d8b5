#include "sim/terms/sensor_mount.hpp"

#include <stdexcept>
#include <utility>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

constexpr double within_reach = 0.5;   // of speed over way: three times what the body rings at
constexpr double part_of_body = 1e-4;  // moves the body's own resonances by 5e-5

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

}  // namespace

TermType sensor_mount() {
  return {
      .card = {.name = "sensor_mount",
               .equation = "shown/moved = (1 + 2jζr)/(1 − r² + 2jζr), r = frequency/f",
               .sign = "f > 0",
               .leaves_out = "the sensor's own mass, tilt, more than one mode",
               .source = "ISO 5348 (2021); Rao, Mechanical Vibrations, ch. 3.6",
               .touches = {{Ledger::fixed_frequency,
                            "one channel: all that is near f, at all speeds and loads"},
                           {Ledger::broadband, "one channel: a hump at f"}},
               .must_not_touch = {{Ledger::fixed_frequency, "any other channel of the body"},
                                  {Ledger::quasi_static, "means"}},
               .mimics = {"housing_mode", "torsional_mode", "looseness"},
               .experiment = "swap the sensors: it stays with the mount; glue it: f rises"},
      .parameters =
          {{.name = "frequency",
            .unit = UnitKind::frequency,
            .min = smallest,
            .max = 1e6,
            .start = within_reach},
           {.name = "damping_ratio", .unit = UnitKind::ratio, .min = 0, .max = 1, .start = 0.03}},
      .gate = {.rotation = false, .in_channel = InChannel::of_a_motion},
      .edit = loosen};
}

}  // namespace rvbench::sim
