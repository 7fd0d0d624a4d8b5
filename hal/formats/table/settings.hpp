#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// What the lines above a table say plainly.
struct TableSettings {
  std::optional<double> rate_Hz;
  std::string rate_line;           ///< the line that says so
  std::vector<std::string> units;  ///< of a line of units: one for all columns, or one for each
  double speed_rpm = not_known;
};

/// Reads "Sample Rate: 25.6 kHz", "Sample Interval,0.001,s", "Delta_X\t0.000039", "Unit,g" and
/// such. A number without a unit counts where the setting's name can mean only one. Two lines that
/// give different rates give none.
///
/// @param above  lines without comment marks; @param separator  of the table's cells
TableSettings settings_in(const std::vector<std::string>& above, char separator);

}  // namespace rvbench::hal::formats
