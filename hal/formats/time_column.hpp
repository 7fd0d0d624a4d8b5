#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// What the first column of a table without names is called.
inline constexpr std::string_view first_without_name = "column_1";

/// Gives all channels of a table the rate that its time column says; the column stays.
///
/// A time column is one named so (time_unit_s) or, in a table without names, a first one that rises
/// evenly from 0. If no unit is stated, steps of at most `longest_unstated_step` are s, with a
/// note: no recorder samples a thousand times faster. Longer steps may be s or ms; they give no
/// rate, and a note says so. A column that rises unevenly gives no rate.
///
/// @param has_names  the file has them: "column_1" is otherwise made up
void set_rate_by_time_column(bool has_names, Recording& table);

inline constexpr double longest_unstated_step = 2e-3;

/// Takes the time column by which all other channels have their rate off a table: its first value
/// is when they start. A table of time alone stays as it is.
void drop_time_column(Recording& table);

/// Seconds in the unit of a column named as time: "time", "t", "time_s", "Time (ms)"; 1 if the name
/// states none, nothing if it is not named so.
std::optional<double> time_unit_s(std::string_view name);

/// Whether the name of a time column states its unit.
bool states_time_unit(std::string_view name);

/// Seconds in the unit of time that the name of a column ends in: "t_us", "clock [ms]"; nothing if
/// it ends in none.
std::optional<double> seconds_per_unit(std::string_view name);

/// As a clock does. Steps of zero are the rounding of a printed time.
bool only_rises(const Eigen::VectorXd& x);

}  // namespace rvbench::hal::formats
