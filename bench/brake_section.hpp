#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hal/can/can_brake.hpp"
#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// What a rig file says of its load brake, which is on the CAN bus and speaks the frames 0x201 and
/// 0x281 of hal/can/can_frames:
///
///     "brake": {"max_torque_Nm": 400, "deadline_s": 0.2}
struct BrakeSection {
  hal::CanBrakeOptions options;
};

/// Faults are noted at `brake`.
BrakeSection read_brake_section(hal::ConfigReader& brake);

/// With every default spelled out.
nlohmann::ordered_json to_json(const BrakeSection& brake);

}  // namespace rvbench::bench
