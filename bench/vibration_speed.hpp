#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// How a campaign has the speed of a shaft read from vibration.
struct VibrationSpeed {
  std::string kinematics;       ///< whose lines are sought: those of its meshes, else all
  int harmonics = 4;            ///< of each
  double turns_per_sample = 0;  ///< about
  double within_pct = 3;        ///< how far it may be off that
  double block_turns = 30;
  std::string relative_to;  ///< path of the recording whose speed is 1; "" for rad/s
  double nominal_Hz = 0;    ///< the shaft's there: gives times where no file states a rate
};

/// {"kinematics": "two_stage", "turns_per_sample": 0.007, "relative_to": "no_load.csv", ...}
VibrationSpeed parse_vibration_speed(hal::ConfigReader& json, const std::filesystem::path& folder);

/// Puts the channel `speed` in the place of all that `recording` holds: of the shaft, relative (1)
/// or in rad/s, half a block apart.
///
/// Up to a tenth of the blocks may fail to show the lines; straight lines bridge them, with a note.
/// A recording without a rate gets the times it would have if the other's shaft turned at
/// nominal_Hz. Its own speed is not resolvable then.
/// @param reference  the recording relative_to, or nullptr
/// @return why it cannot be had; "" if it can
std::string use_vibration_speed(Recording& recording, const Recording* reference,
                                const VibrationSpeed& how, std::vector<std::string>& notes);

}  // namespace rvbench::bench
