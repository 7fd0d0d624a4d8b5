#pragma once

#include <string>
#include <vector>

#include "analysis/compare/matched_points.hpp"
#include "analysis/compare/quantities.hpp"
#include "analysis/compare/record_levels.hpp"

namespace rvbench::analysis {

struct CompareOptions {
  double least_dB = 1;        ///< a change that nobody minds; >= 0
  double false_share = 0.05;  ///< of what is called changed; in (0, 1)
  double blind_dB = 6;        ///< where smaller changes would be missed nothing is told; > least_dB
};

enum class ChangeWord { changed, not_changed, cannot_tell };

/// What the scatter of a change was learned from.
enum class ScatterSource {
  repeats,  ///< of the point
  parts,    ///< of the one record that either has: what differs from start to start is not in it
  none
};

/// One quantity of one channel at one point, B against A.
struct Change {
  std::size_t point = 0;                      ///< index into Comparison::points
  std::size_t channel = 0;                    ///< into Comparison::channels
  std::size_t quantity = 0;                   ///< into Comparison::quantities
  double a_dB = not_known, b_dB = not_known;  ///< mean levels, re 1 unit of the channel
  double change_dB = not_known;
  double uncertainty_dB = not_known;  ///< half of the 95 % interval of the change
  ScatterSource source = ScatterSource::none;
  double freedom = 0;
  double p_value = not_known;        ///< of no more than least_dB, by chance
  double adjusted_p = not_known;     ///< for all that was compared
  double detectable_dB = not_known;  ///< a change that would have been called in nine of ten cases
  bool seen_a = false,
       seen_b = false;  ///< a line that stands out of the noise; a level always does
  ChangeWord word = ChangeWord::cannot_tell;

  /// Of a line that neither shows, only the noise at its place is known.
  bool is_seen() const { return seen_a || seen_b; }
};

struct Comparison {
  CompareOptions options;
  std::vector<Quantity> quantities;
  std::vector<ChannelInfo> channels;  ///< those compared somewhere
  std::vector<MatchedPoint> points;
  std::vector<PointRecords> only_a, only_b;
  std::vector<Change> changes;        ///< by point, channel, quantity
  std::vector<NotCompared> left_out;  ///< records and channels, A first
};

/// Holds the records of B against those of A, point by point, each channel against that of the same
/// name, unit, direction and rate.
///
///     Δ = mean of B's levels − mean of A's levels, in dB
///
/// Shape    any number of records → changes by point, channel and quantity; each record has one
///          level per quantity
/// Units    dB
/// Scatter  of the repeats, pooled over A and B, where either has two; else of the parts of the one
///          record. Cells whose quantity is of one kind learn from each other, see
///          drawn_together(): a level everywhere; lines that stand equally high above their noise
/// Test     test_change() against least_dB; called by adjusted_p_values() up to false_share
/// Errors   throws std::invalid_argument: options out of range
/// Source   of each of these; what is held against what, and when nothing is told, is ours
Comparison compare(const std::vector<RecordLevels>& a, const std::vector<RecordLevels>& b,
                   const std::vector<Quantity>& quantities, const CompareOptions& options = {});

}  // namespace rvbench::analysis
