#pragma once

#include <string>

#include "analysis/kinematics.hpp"

namespace rvbench::bench {

/// Each part of a machine with its order, the limit of its severity and why: a line each, for a
/// terminal.
/// Units  orders of the input shaft. Errors  none thrown. Source  the kinematics
std::string part_limits_text(const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
