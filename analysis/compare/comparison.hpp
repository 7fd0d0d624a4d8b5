#pragma once

#include <string>
#include <vector>

#include "analysis/compare/line_level.hpp"
#include "analysis/compare/matched_points.hpp"
#include "analysis/compare/quantities.hpp"
#include "analysis/compare/record_levels.hpp"
#include "analysis/compare/same_records.hpp"
#include "analysis/compare/slipping_comb.hpp"

namespace rvbench::analysis {

struct CompareOptions {
  double least_dB = 1;        ///< a change that nobody minds; >= 0
  double false_share = 0.05;  ///< expected, of what is called changed; in (0, 1)
  double blind_dB = 6;        ///< where smaller changes would be missed nothing is told; > least_dB
  double seen_p = analysis::seen_p;    ///< of noise alone, up to which a line is seen; in (0, 1)
  double found_p = analysis::found_p;  ///< likewise, of all lines of a part that slips
};

enum class ChangeWord { changed, not_changed, cannot_tell };

/// What the scatter of a change was learned from.
enum class ScatterSource {
  repeats,  ///< of the point
  parts,    ///< of the one record that either has: what differs from start to start is not in it
  none      ///< too short for parts, or repeats that agree to the last digit: copies, no scatter
};

/// One quantity of one channel at one point, B against A.
struct Change {
  std::size_t point = 0;                      ///< index into Comparison::points
  std::size_t channel = 0;                    ///< into Comparison::channels
  std::size_t quantity = 0;                   ///< into Comparison::quantities
  double a_dB = not_known, b_dB = not_known;  ///< mean levels of records, re 1 unit of the channel
  double change_dB = not_known;       ///< of the means of what the scatter is of: records, or parts
  double uncertainty_dB = not_known;  ///< half of the 95 % interval of the change
  ScatterSource source = ScatterSource::none;
  double freedom = 0;
  double p_value = not_known;        ///< of no more than least_dB, by chance
  double adjusted_p = not_known;     ///< for all cells that are seen, or for all that are not
  double detectable_dB = not_known;  ///< a change that would have been called in nine of ten cases
  bool seen_a = false, seen_b = false;  ///< a line stands out of the noise of A's records, of B's
  bool seen = false;   ///< of all records of both taken together; else only the noise at its place
                       ///< is known. A level is always seen
  bool taken = false;  ///< in A, B or both another part's line stands there, too: not held
  ChangeWord word = ChangeWord::cannot_tell;
};

struct Comparison {
  CompareOptions options;
  std::vector<Quantity> quantities;
  std::vector<ChannelInfo> channels;  ///< those compared somewhere
  std::vector<MatchedPoint> points;
  std::vector<PointRecords> only_a, only_b;
  std::vector<Change> changes;                ///< by point, channel, quantity
  std::vector<SignaturePair> unparted;        ///< whose lines are the same in some record
  std::vector<NotCompared> left_out;          ///< records and channels, A first
  std::vector<ShortRecord> too_short = {};    ///< those whose lines are not compared
  std::vector<SameRecord> same_in_both = {};  ///< of those compared, B's that are A's, too
  std::size_t records_a = 0;                  ///< that are compared at some point
  std::size_t records_b = 0;
};

/// Holds the records of B against those of A, point by point, each channel against that of the same
/// name, unit, direction and rate.
///
///     Δ = mean of B's levels − mean of A's levels, in dB
///
/// A line is seen where noise alone would show as much once in 10 000, by combined_p_value() of the
/// records; one of a part that slips, where the part is found as well, by the median of a side's
/// p-values, of the surer side. Cells that are seen and cells that are not pay each for themselves:
/// of the former alone headlines are made, and noise that changed everywhere must not make their
/// calls cheap. Which lines are seen is told by the records of both together: the sum of powers of
/// noise knows nothing of their ratio, which is what is tested.
///
/// Shape    any number of records → changes by point, channel and quantity; each record has one
///          level per quantity
/// Units    dB
/// Scatter  of the repeats, pooled over A and B, where either has two; else of the parts of the one
///          record, and then Δ is that of the parts, too: a peak of the whole scatters otherwise.
///          Cells whose quantity is of one kind learn from each other, see drawn_together(): a
///          level everywhere; lines that stand equally high above their noise
/// Test     test_change() against least_dB; called by adjusted_p_values() up to false_share
/// Limits   false_share is what to expect of all seen cells together that are called changed; of
///          those of one quantity, part or point alone it says nothing. Of a part that slips and is
///          just found, the surer side is rather the higher one: among such cells changes are met
///          more often than among all
/// Errors   throws std::invalid_argument: options out of range
/// Source   of each of these; cells chosen by what is independent of the test: Bourgon, Gentleman &
///          Huber, PNAS 107(21), 9546-9551 (2010); sums and ratios of powers: Lukacs, Ann. Math.
///          Stat. 26(2), 319-324 (1955); what is held against what, and when nothing is told, is
///          ours
Comparison compare(const std::vector<RecordLevels>& a, const std::vector<RecordLevels>& b,
                   const std::vector<Quantity>& quantities, const CompareOptions& options = {});

}  // namespace rvbench::analysis
