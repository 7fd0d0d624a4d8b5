#include "bench/brake_section.hpp"

#include <nlohmann/json.hpp>

#include "hal/can/can_frames.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {

BrakeSection read_brake_section(hal::ConfigReader& brake) {
  BrakeSection section;
  hal::CanBrakeOptions& options = section.options;
  options.limits.max_torque_Nm =
      brake.number("max_torque_Nm", {0.1, hal::can_frames::max_brake_torque_Nm});
  options.limits.residual_torque_pct =
      brake.number("residual_torque_pct", {0.1, 20}, options.limits.residual_torque_pct);
  options.deadline_s = brake.number("deadline_s", {0.02, 2}, options.deadline_s);
  return section;
}

nlohmann::ordered_json to_json(const BrakeSection& brake) {
  return hal::json_object({{"max_torque_Nm", brake.options.limits.max_torque_Nm},
                           {"residual_torque_pct", brake.options.limits.residual_torque_pct},
                           {"deadline_s", brake.options.deadline_s}});
}

}  // namespace rvbench::bench
