#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/bench_rig.hpp"
#include "bench/rig_factory.hpp"

namespace rvbench::bench {

/// A device of the simulated bench that misbehaves from `at_s` of the rig's time on.
struct ScheduledFault {
  double at_s = 0;
  std::string device;  ///< "inverter"
  std::string fault;   ///< "late", "silent", "garbled", "busy", "dead"; "none" heals it
};

/// {"rig": "sim"}
struct SimRig {
  std::string preset;
  std::uint64_t seed = 1;
  std::optional<double>
      severity;  ///< of the fault, in those of the preset; none: the seed draws it
  std::string plant = "rv20e_bench";  ///< shipped, or a plant file: what turns, as on the drawing
  double watchdog_s = 1;              ///< of the inverter; 0 = off
  bool holding_brake =
      false;  ///< it holds at standstill, as a hysteresis test needs; else it creeps
  std::vector<ScheduledFault> faults;
  std::optional<QualificationSection> qualification =
      {};  ///< none: nothing is asked of the station
};

/// {"rig": "replay"}
struct ReplayRig {
  std::string recording;
  std::string pace = "virtual";  ///< or "real_time": as it was recorded
  double rated_output_torque_Nm = 167;
  std::string plant = "rv20e_bench";  ///< shipped, or a plant file: what was recorded
};

using RigFile = std::variant<SimRig, ReplayRig, BenchRig>;

/// The plant that stands for what the rig turns.
std::string plant_of(const RigFile& rig);

/// What the rig file asks of its station; null if nothing.
const QualificationSection* qualification_in(const RigFile& rig);

/// The channels of the rig that somebody may calibrate, with the sensitivities it goes by.
std::vector<ChannelInfo> channels_of(const RigFile& rig);

/// As make_rig(), remarks_on() and rig_to_json() of the rig's file, which is not read again.
/// @param rig  the file's name, for its faults
std::variant<hal::Rig, std::vector<hal::ConfigFault>> make_rig(const RigFile& file,
                                                               const std::string& rig);
RigRemarks remarks_on(const RigFile& file, const std::string& rig);
std::string rig_to_json(const RigFile& file);

/// What a rig is, from "sim" or a file. Options fill in what the file leaves open.
std::variant<RigFile, std::vector<hal::ConfigFault>> read_rig(const std::string& rig,
                                                              const RigOptions& options);

}  // namespace rvbench::bench
