#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/comb_evidence.hpp"

namespace rvbench::analysis {

/// What all IMFs of one channel say to one signature.
struct ChannelEvidence {
  CombEvidence sum;       ///< log ratios and decoys summed; depths weighed by each IMF's share
  std::vector<int> imfs;  ///< 1-based: those that were read
  std::vector<Eigen::VectorXd> by_stretch;  ///< of each: Σ log_ratio over the lines

  /// @param share  of the channel's power that the IMF carries, 0..1
  void add(const CombEvidence& evidence, int imf, double share);
};

/// Scores all signatures on one record: log-likelihood ratios summed over lines, IMFs and channels,
/// at the one stretch of each comb that explains them best.
///
/// Of the parts that roll, the deepest family explains its lines first, and the others count what
/// is left: within the slip allowed, 3·BPFO of one race falls on 2·BPFI of the other.
///
/// Shape   channels[c][s]: of channel c and comb s; one score per comb, in their order
/// Units   orders; depths over the mean envelope
/// Errors  throws std::invalid_argument: a channel that has not one evidence for each comb
/// Source  p-values: decoy_p_value(), times the stretches tried; who explains what first is ours
std::vector<SignatureScore> score_signatures(
    const std::vector<std::vector<ChannelEvidence>>& channels,
    const std::vector<SignatureComb>& combs);

}  // namespace rvbench::analysis
