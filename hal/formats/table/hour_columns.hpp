#pragma once

#include "hal/formats/table/table.hpp"

namespace rvbench::hal::formats {

/// Replaces columns of hours, minutes, seconds and parts of a second, which some recorders write as
/// the first ones, by one column "time [s]". They are known by their names, or, in a table without
/// names, by values that run like a clock and rise evenly. @return whether it did
bool join_hour_columns(Table& table);

}  // namespace rvbench::hal::formats
