#pragma once

#include <cstddef>
#include <vector>

#include "analysis/compare/record_levels.hpp"

namespace rvbench::analysis {

/// A record that is on both sides.
struct SameRecord {
  std::size_t a = 0, b = 0;  ///< indices
};

/// Records of B that are one of A's, whatever they are called: the level of every value of every
/// channel agrees to the last digit, which no two measurements do.
/// Limits  one of which a channel more is compared is not known again
/// Shape   at most one pair per record of B, by rising b; a record without a channel is none
/// Errors  none thrown. Source  ours
std::vector<SameRecord> same_records(const std::vector<RecordLevels>& a,
                                     const std::vector<RecordLevels>& b);

}  // namespace rvbench::analysis
