#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::analysis {

/// Where a line that wanders is looked for, and how fast it may.
struct RidgeSearch {
  double from_Hz = 0;
  double to_Hz = 0;
  double block_s = 1;           ///< of each spectrum: about 4 / block_s apart from any other line
  double most_change_Hz_s = 0;  ///< how fast the frequency may change; one line per step at least
};

/// A line of a spectrum, followed through time.
struct LineRidge {
  double start_s = 0;            ///< middle of the first block, from the first sample on
  double step_s = 0;             ///< half a block
  Eigen::VectorXd frequency_Hz;  ///< of each block
  double p_value = 1;            ///< that noise alone has a ridge like it within the search
};

/// Follows the line that stands out most between two frequencies: the path through Hann spectra
/// of blocks, half a block apart, on which
///
///     S = Σ_blocks ln(1 + P / floor)
///
/// is largest; the floor is the median of a block's lines within the search. A coarse speed: within
/// a block the frequency is one number.
///
/// Shape    N samples → one frequency per block; empty if not one block fits, or if p_value is not
///          below 1e-3: then there is no line to follow
/// Units    x in any; Hz. With rate_Hz = 1 all is in cycles per sample, and times in samples:
///          no rate needs to be known
/// Errors   throws std::invalid_argument: band not within half the rate, or narrower than 16 lines;
///          a block of less than 32 samples; a sample not finite
/// Limits   between lines the frequency is right to about 0.01 lines at 40 dB over the floor; a
///          change of more than one line within a block blurs it
/// Source   Viterbi, IEEE Trans. Inf. Theory 13(2), 260-269 (1967), for the path. p_value: Chernoff
///          bound of S over independent blocks, exponential lines, times the number of paths
std::optional<LineRidge> line_ridge(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                    const RidgeSearch& search);

}  // namespace rvbench::analysis
