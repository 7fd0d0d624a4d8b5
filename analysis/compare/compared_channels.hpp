#pragma once

#include <string>
#include <vector>

#include "analysis/compare/matched_points.hpp"

namespace rvbench::analysis {

/// One channel at one point, as the repeats of both have it.
struct ChannelPair {
  std::string name;
  std::vector<const ChannelLevels*> a, b;  ///< one at least in each
};

/// Channels that can be compared at a point. The others are told: in one of both only, or of
/// another unit, direction or sample rate. So is a unit or direction that some do not state.
/// @param left_out  is added to
/// Shape   as many as there are, by name. Errors  none thrown
/// Source  ours: what has another unit, direction or band was not measured alike
std::vector<ChannelPair> compared_channels(const MatchedPoint& point,
                                           const std::vector<RecordLevels>& a,
                                           const std::vector<RecordLevels>& b,
                                           std::vector<NotCompared>& left_out);

/// "1815 rpm, 100 % load"; "speed not known" for NaN, and no word of a load that is.
/// Errors  none thrown. Source  ours
std::string point_text(double speed_rpm, double load_pct);

}  // namespace rvbench::analysis
