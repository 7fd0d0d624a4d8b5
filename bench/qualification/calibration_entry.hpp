#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bench/qualification/station_records.hpp"

namespace rvbench::bench {

/// What somebody says of a sensor's certificate, as texts of a command line.
struct CalibrationEntry {
  std::string channel, certificate, by;
  std::string on, until;              ///< days, as "2026-11-02"
  std::optional<double> sensitivity;  ///< V per unit of the channel
  bool no_sensitivity = false;        ///< the certificate states none
};

/// The record of it.
/// @param channels  that the rig has
/// @return or what is wrong with it, beginning with the option's name where it is of one
std::variant<CalibrationRecord, std::string> calibration_record(
    const CalibrationEntry& entry, const std::string& station,
    const std::vector<std::string>& channels, const std::string& now_utc);

}  // namespace rvbench::bench
