#pragma once

#include <optional>
#include <vector>

#include "analysis/tpa/matrix_inverse.hpp"

namespace rvbench::analysis {

/// Forces at the paths and what each adds to each target, over time.
struct PathHistories {
  double rate_Hz = 0;
  Eigen::MatrixXd forces;                      ///< samples x paths
  std::vector<Eigen::MatrixXd> contributions;  ///< one per target: samples x paths
  double reach_back_s = 0;   ///< of contributions, twice that of forces: what was before the record
                             ///< is not known to the filters
  double reach_ahead_s = 0;  ///< as well, what comes after it
  double cut_share = 0;  ///< of the worst filter's energy, what its taps and their fading cut off
};

/// Histories by filters of the same inverse and FRFs that contributions were found with: causal,
/// phase kept, over the band of the lines, as long as the lines can tell (1/step); delays are taken
/// out again.
///
/// @param inputs  samples x contributions.inputs
/// Shape   samples of the inputs
/// Units   those of the contributions
/// Errors  nullopt where the rate or the first line is no multiple of the lines' step, or there are
///         fewer than eight lines. Throws std::invalid_argument: inputs of other sensors
/// Limits  one steady inverse for all of the record; edges of the band fade over ten lines, of
///         contributions twice; within
///         the filters' reach of either end histories are not whole
/// Source  deconvolution_filters(), MimoConvolver
std::optional<PathHistories> path_histories(const PathContributions& contributions,
                                            const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                            double rate_Hz);

/// RMS of each column over so many stretches of equal length: columns x stretches.
/// Errors  throws std::invalid_argument: more stretches than samples, none. Source  definition
Eigen::MatrixXd rms_over_time(const Eigen::MatrixXd& samples, Eigen::Index stretches);

}  // namespace rvbench::analysis
