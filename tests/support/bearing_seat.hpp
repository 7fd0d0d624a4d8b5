#pragma once

#include "sim/plant_spec.hpp"

namespace rvbench::test {

/// 1 kg on a spring and a damper, with the bearing of the rig of the CWRU Bearing Data Center,
/// whose shaft turns as "shaft_speed" says, seen by an accelerometer as "vibration" from 300 Hz to
/// `to_Hz`.
/// @param bearing  what is other than of a sound one
inline sim::PlantSpec bearing_seat(const sim::Parameters& bearing, double to_Hz) {
  sim::PlantSpec plant;
  plant.name = "seat";
  plant.bodies = {{"seat", sim::Motion::translation, {1, "kg"}}};
  plant.terms = {{"spring", "spring", "seat", "housing", "", {{"stiffness", {1.6e8, "N/m"}}}},
                 {"damper", "damper", "seat", "housing", "", {{"damping", {2000, "N·s/m"}}}},
                 {"bearing",
                  "rolling_bearing",
                  "seat",
                  "housing",
                  "shaft_speed",
                  {{"balls", {9, "1"}},
                   {"ball_diameter", {7.94e-3, "m"}},
                   {"pitch_diameter", {39.04e-3, "m"}},
                   {"contact_angle", {0, "rad"}},
                   {"roughness_force", {1, "N"}},
                   {"roughness_corner", {1000, "Hz"}},
                   {"load_zone_once", {0, "1"}},
                   {"load_zone_twice", {0, "1"}},
                   {"spalled_part", {0, "1"}},
                   {"impact_impulse", {0, "N·s"}},
                   {"impact_time", {1e-4, "s"}},
                   {"impact_scatter", {0, "1"}},
                   {"seed", {0, "1"}}}}};
  for (const auto& [name, quantity] : bearing) plant.terms[2].parameters[name] = quantity;
  plant.inputs = {{.name = "shaft_speed",
                   .channel = "shaft_speed",
                   .unit = "Hz",
                   .kind = sim::InputKind::signal,
                   .body = "",
                   .gain = {1, "1"},
                   .offset = {0, "Hz"}}};
  plant.outputs = {{.channel = "vibration",
                    .unit = "m/s²",
                    .kind = sim::OutputKind::acceleration,
                    .of = "seat",
                    .gain = {1, "1"},
                    .offset = {0, "m/s²"},
                    .delay = {0, "s"},
                    .compared_by = sim::ComparedBy::envelope,
                    .from_Hz = 300,
                    .to_Hz = to_Hz}};
  return plant;
}

}  // namespace rvbench::test
