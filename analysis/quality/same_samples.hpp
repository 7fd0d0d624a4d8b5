#pragma once

#include <cstddef>
#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Which channels hold one signal: for each the first that has the same samples at the same rate,
/// itself where no earlier one has. Two sensors never hear the same to the last bit: a plug was
/// copied, or a column.
///
/// Shape   N channels → N indices, each at most its own. Units  any
/// Errors  none thrown. Source  ours
/// Limits  channels without samples, or with lost ones, are like no other
std::vector<std::size_t> first_of_same(const std::vector<const Channel*>& channels);

}  // namespace rvbench::analysis
