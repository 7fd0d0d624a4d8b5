#pragma once

#include "hal/formats/table/table.hpp"

namespace rvbench::hal::formats {

/// Makes the table's clock of columns of hours, minutes, seconds and parts of a second, which some
/// recorders write as the first ones. Their names show them or, in a table without names, values
/// that run like a clock and rise evenly. @return whether it did
bool join_hour_columns(Table& table);

}  // namespace rvbench::hal::formats
