#pragma once

#include <vector>

#include "analysis/tpa/matrix_inverse.hpp"

namespace rvbench::analysis {

/// What one path adds to one target over a band.
struct BandContribution {
  Eigen::Index path = 0;
  double rms = 0;             ///< of its partial response, in the target's unit
  double phase_rad = 0;       ///< against the measured target: angle of ΣP·conj(Y)
  double coherent_share = 0;  ///< Re(ΣP·conj(Y)) / Σ|Y|²: negative where it makes the target less
};

/// Paths of a target over a band, the largest first.
struct TargetRanking {
  Eigen::Index target = 0;
  TpaBand band;
  std::vector<BandContribution> paths;
  double measured_rms = 0;      ///< of the target
  double synthesised_rms = 0;   ///< of the sum of all paths
  double validation_score = 0;  ///< over the band, at sensors that were not fitted to
  Eigen::Index lines = 0;       ///< used
  Eigen::Index lines_left_out = 0;
};

/// Ranks the paths by the RMS of their partial responses, for each band and each target in it.
///
/// Sums are over the band's used lines and all blocks. Coherent shares of all paths add up to what
/// the synthesis and the target have in common; RMS values do not add up to anything.
///
/// Shape   bands x targets, targets of a band in a row
/// Units   those of the targets
/// Errors  throws std::invalid_argument: no band, one that holds no line
/// Source  van der Seijs, de Klerk & Rixen, Mech. Syst. Signal Process. 68-69, 217-244 (2016)
std::vector<TargetRanking> rank_contributions(const PathContributions& contributions,
                                              const std::vector<TpaBand>& bands);

/// Mean square of each path's partial response at each target over a band: paths x targets, without
/// what noise adds on average; 0 where that is more than all.
/// Units  of the targets, squared. Errors  none thrown
Eigen::MatrixXd partial_mean_squares(const PathContributions& contributions, const TpaBand& band);

}  // namespace rvbench::analysis
