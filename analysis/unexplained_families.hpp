#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// What no kinematics accounts for, over all channels and points: each order once, where it is
/// strongest, and of these the families() that they form, the twelve strongest.
///
/// Units   of the examinations
/// Errors  none thrown
/// Source  of families()
std::vector<SpectralLine> unexplained_families(const std::vector<Examination>& points,
                                               const Kinematics& kinematics);

}  // namespace rvbench::analysis
