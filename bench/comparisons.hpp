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

/// Empty if nothing was fitted, or one of the plants cannot be simulated.
Comparisons compare(const Twin& twin, const analysis::Selection& found);

std::vector<RecordError> record_errors(const Twin& twin, const analysis::Selection& found,
                                       const Comparisons& comparisons);

}  // namespace rvbench::bench
