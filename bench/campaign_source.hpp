#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/vibration_speed.hpp"
#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// A channel that nobody recorded because it never changed.
struct ConstantChannel {
  std::string name, unit;
  double value = 0;
};

/// What a campaign says of one of its files: how channels are made of it.
struct CampaignSource {
  std::string path;
  double rate_Hz = not_known;
  std::string time_column = {};
  std::vector<std::string> columns = {};
  std::optional<VibrationSpeed> vibration_speed = {};
  std::vector<ConstantChannel> constants = {};
};

CampaignSource parse_source(hal::ConfigReader& json, const std::filesystem::path& folder);

/// Leaves the channels of one clock: those that are as long as the first of those named that is
/// there; as the longest of all, if none is.
/// @return why not: "" if there are such channels
std::string keep_one_clock(Recording& recording, const std::vector<std::string>& wanted);

/// @param wanted  see keep_one_clock()
/// @param notes   is told what was done to the data
/// @return recordings of one rate and one length each, or why the file cannot be used
std::variant<std::vector<Recording>, std::string> read_source(
    const CampaignSource& source, const std::vector<std::string>& wanted,
    std::vector<std::string>& notes);

}  // namespace rvbench::bench
