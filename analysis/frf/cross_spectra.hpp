#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/frf/frf_record.hpp"

namespace rvbench::analysis {

/// Mean products of spectra, all that an estimate of frequency responses is made of. Not scaled to
/// densities: a response is a ratio of them.
struct CrossSpectra {
  double step_Hz = 0;   ///< of the lines 0..N/2
  int records = 0;      ///< hits or blocks
  double averages = 0;  ///< independent ones they are worth; fewer than blocks that overlap
  std::vector<Eigen::MatrixXcd> excitations;  ///< per line, E x E: mean of x·xᴴ
  std::vector<Eigen::MatrixXcd> cross;        ///< per line, R x E: mean of y·xᴴ
  Eigen::MatrixXd responses;                  ///< lines x R: mean of |y|²

  Eigen::Index lines() const { return responses.rows(); }
};

/// Of records as they are, such as hits in their windows, each of which counts alike.
/// Shape   N samples → N/2 + 1 lines
/// Units   of the record, squared, times samples squared
/// Errors  throws std::invalid_argument: no record, records differ in rate, length or channels, or
///         are not finite
/// Source  Bendat & Piersol, Random Data (4th ed., 2010), sec. 11.5
CrossSpectra hit_spectra(const std::vector<FrfRecord>& records);

/// How a long record under random excitation is averaged.
struct BlockAverage {
  double block_s = 1;
  double overlap = 0.5;  ///< share of a block that the next one has in common, in [0, 1)
};

/// Of Hann blocks of a long record, each without its mean. Blocks that overlap are worth fewer:
/// K / (1 + 2·Σ (1-k/K)·ρₖ²), where ρₖ is the correlation of windows k steps apart.
/// Shape   block_s·rate samples → half as many lines and one
/// Units   of hit_spectra()
/// Errors  throws std::invalid_argument: overlap out of range, a block below 16 samples or longer
///         than the record, channels that differ in length, samples not finite
/// Limits  a resonance narrower than two lines is smeared: coherence falls there, and H1 reads low
/// Source  Welch, IEEE Trans. Audio Electroacoust. 15(2), 70-73 (1967)
CrossSpectra block_spectra(const FrfRecord& record, const BlockAverage& average);

}  // namespace rvbench::analysis
