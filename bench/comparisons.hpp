#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analysis/explain/selection.hpp"
#include "bench/twin.hpp"

namespace rvbench::bench {

/// Mean of a channel over a record that was only predicted, and the interval that holds nine in ten
/// of its values.
struct PredictedMean {
  double measured = 0, predicted = 0, half_width = 0;
  bool is_inside() const { return std::abs(measured - predicted) <= half_width; }
};

/// How far a record is from the plant, as it was and with what was left out.
struct RecordError {
  std::string record, channel, unit;
  bool learned_from = true;
  double before = 0, after = 0;                    ///< RMS, in the channel's unit
  double relative_before = 0, relative_after = 0;  ///< of the RMS of what was measured
  /// Of one that is not learned from, where residuals are relative to what a channel shows.
  std::optional<PredictedMean> mean = {};
};

/// A record beside what the plant makes of it, as it was and with what was left out, by fits that
/// have not seen the record's condition.
struct UnseenRecord {
  Twin::Comparison before, after;
  Eigen::VectorXd scatter;  ///< of repeats: half-width that holds nine in ten; empty: not known
};

/// Every record and output beside the plant as it was, and with what was left out.
struct Comparisons {
  std::vector<Twin::Comparison> before, after;  ///< of one length
  std::vector<UnseenRecord> unseen;             ///< some of them: as they are predicted
};

/// Sets every record of the twin beside the plant as it was, and beside what was found; of those
/// that are only predicted, and some that are learned from, also by fits without their condition.
///
/// Shape   one pair per record and output, in the twin's order; empty if nothing was fitted, or one
///         of the plants cannot be simulated
/// Units   those of the channels
/// Errors  throws Interrupted, of the twin, when a stop is requested
/// Source  of the twin; which records are shown is ours
Comparisons compare(const Twin& twin, const analysis::Selection& found);

/// How far each of them is from what was measured: root mean squares, and, of records that are only
/// predicted and compared sample by sample, the mean with its interval.
///
/// Shape   one per pair of `comparisons`, in their order
/// Units   those of the channels; relative errors none
/// Errors  throws Interrupted, of the twin; std::invalid_argument of PredictiveError
/// Source  PredictiveError for the interval
std::vector<RecordError> record_errors(const Twin& twin, const analysis::Selection& found,
                                       const Comparisons& comparisons);

}  // namespace rvbench::bench
