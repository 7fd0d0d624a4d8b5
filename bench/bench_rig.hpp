#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/accelerometer_section.hpp"
#include "bench/brake_section.hpp"
#include "bench/can_section.hpp"
#include "bench/drive_section.hpp"
#include "bench/qualification/qualification_section.hpp"
#include "bench/safety_section.hpp"
#include "bench/torque_section.hpp"
#include "hal/config_reader.hpp"
#include "hal/rig.hpp"

namespace rvbench::bench {

/// {"rig": "bench"}: real devices. A drive alone is enough to be probed; a run needs them all.
struct BenchRig {
  DriveSection drive;
  std::optional<CanSection> can;
  std::optional<TorqueSection> torque;
  std::optional<BrakeSection> brake;
  std::optional<AccelerometerSection> accelerometers;
  std::optional<SafetySection> safety;
  std::string plant = "rv20e_bench";  ///< shipped, or a plant file: what turns
  std::optional<QualificationSection> qualification;  ///< none: nothing is asked of the station
};

/// Faults are noted at `root`.
BenchRig read_bench_rig(hal::ConfigReader& root);

/// With every default spelled out.
nlohmann::ordered_json to_json(const BenchRig& rig);

/// The channels that somebody may calibrate, with the sensitivities that the file states.
std::vector<ChannelInfo> channels_of(const BenchRig& rig);

/// What a run needs and the file does not have; nothing that a probe would miss. Without lines.
std::vector<hal::ConfigFault> unfit_for_runs(const BenchRig& rig);

/// The rig, not yet connected, on a clock of its own; or what a run lacks.
std::variant<hal::Rig, std::vector<hal::ConfigFault>> make_bench(const BenchRig& rig);

}  // namespace rvbench::bench
