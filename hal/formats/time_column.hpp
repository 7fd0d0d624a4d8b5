#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// Gives all channels of a table the rate that its time column says; the column stays.
///
/// A time column is one named so ("time", "t", "time_s", "Time (ms)"...) or, in a table without
/// names, a first one that rises evenly from 0 in steps below 1: taken as s, with a note. One
/// that rises unevenly says no rate.
///
/// @param has_names  the file has them: "column_1" is otherwise made up
void set_rate_by_time_column(bool has_names, Recording& table);

}  // namespace rvbench::hal::formats
