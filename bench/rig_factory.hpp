#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/rig.hpp"

namespace rvbench::bench {

inline constexpr std::uint64_t max_seed = (1ULL << 53U) - 1;  ///< what a JSON number holds exactly

/// What the command line says about a simulated unit; a rig on hardware has no use for it.
struct RigOptions {
  std::string preset = "healthy";
  std::uint64_t seed = 1;
  std::optional<double> severity = {};  ///< of the preset's fault; none: the seed draws it
};

/// What RigOptions::preset may be.
std::vector<std::string> preset_names();

/// The composition root: the one place that knows which backend plays which role.
///
/// @param rig  "sim", or the path of a rig file: {"rig": "sim", ...} with faults to come at stated
///             times, or {"rig": "replay", "recording": ...}
/// @return the rig, not yet connected, or every fault of the file (of the options: line 0)
std::variant<hal::Rig, std::vector<hal::ConfigFault>> make_rig(const std::string& rig,
                                                               const RigOptions& options);

/// Every fault of a rig file; opens nothing.
std::vector<hal::ConfigFault> check_rig(const std::string& file);

/// What check_rig() does not count as a fault, but somebody should know.
struct RigRemarks {
  std::vector<hal::ConfigFault> unfit_for_runs;  ///< why a run would be refused; a probe would not
  std::vector<hal::ConfigFault> warnings;
};

/// Of a rig file of real devices; none of any other, and of one with faults.
RigRemarks remarks_on(const std::string& file);

/// The rig with every default spelled out: a rig file again.
std::string rig_to_json(const std::string& rig, const RigOptions& options);

}  // namespace rvbench::bench
