#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "sim/draw.hpp"
#include "sim/effect_sites.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::test {

/// An effect as it is hidden in a machine.
struct Hidden {
  nlohmann::json about;  ///< of effects.json
  std::string name;
  sim::EffectSite site;
  sim::Parameters parameters;
  bool shows =
      true;  ///< false: what it does to the means is done by the base within its tolerances
};

/// Somewhere it may act, of random shape. Its largest line is 20 dB below the strongest of the
/// machine's torque; or what it changes of the mean torques is, root mean square and once the base
/// is calibrated, three times what records of one condition differ by. Where that asks for more
/// than all of the shaft's friction, or for thirty times the usual size of such a line effect,
/// three times that of another, it stays that large, and need not show.
/// @return nothing if it can act nowhere
std::optional<Hidden> hide(const sim::PlantSpec& machine, const nlohmann::json& about,
                           sim::Draw& draw);

sim::PlantSpec with(const sim::PlantSpec& plant, const Hidden& hidden);

}  // namespace rvbench::test
