#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hal/can/can_brake.hpp"
#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// What a rig file says of its load brake, which is on the CAN bus and speaks the frames 0x201 and
/// 0x281 of hal/can/can_frames:
///
///     "brake": {"max_torque_Nm": 400, "residual_torque_pct": 2, "deadline_s": 0.2}
///
/// residual_torque_pct, of the largest torque, is what it shows at most though it is released: the
/// drag of its data sheet and the error of its torque reading. Above it a run ends in ERROR
struct BrakeSection {
  hal::CanBrakeOptions options;
};

/// Faults are noted at `brake`.
BrakeSection read_brake_section(hal::ConfigReader& brake);

/// With every default spelled out.
nlohmann::ordered_json to_json(const BrakeSection& brake);

}  // namespace rvbench::bench
