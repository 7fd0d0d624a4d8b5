#pragma once

#include <vector>

#include "analysis/compare/record_levels.hpp"

namespace rvbench::analysis {

/// Repeats of one speed and load: of the slowest, and of these the least loaded of them.
struct PointRecords {
  double speed_rpm = not_known;
  double load_pct = not_known;       ///< NaN: nobody states it
  std::vector<std::size_t> records;  ///< indices, rising
};

/// The matrix that records form, whatever their order: by rising speed, then load. What is within
/// 1 % and one percentage point of the slowest and least loaded of a point belongs to it. A record
/// of which no channel can be compared is in none.
/// Shape   each other record in one point. Units  rpm, %. Errors  none thrown
/// Source  match_points()
std::vector<PointRecords> points_of(const std::vector<RecordLevels>& records);

/// One point in both.
struct MatchedPoint {
  PointRecords a, b;
};

struct MatchedPoints {
  std::vector<MatchedPoint> both;
  std::vector<PointRecords> only_a, only_b;
};

/// Pairs points whose speeds agree within 1 % and whose loads agree within one percentage point, or
/// are both unknown.
/// Shape   each record that has a channel in one point of one list. Units  rpm, %
/// Errors  none thrown. Source  ours: a planned speed may leave out the motor's slip
MatchedPoints match_points(const std::vector<RecordLevels>& a, const std::vector<RecordLevels>& b);

}  // namespace rvbench::analysis
