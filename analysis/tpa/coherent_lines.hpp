#pragma once

#include <vector>

#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// Lines at which the FRFs say what the structure does.
struct CoherentLines {
  std::vector<bool> is_used;  ///< one per line of the FRFs
  Eigen::Index left_out = 0;
  Eigen::VectorXd coherence;  ///< per line: mean over the set, each by the square of its response
};

/// Leaves out the lines whose mean coherence is below a limit. A response near an antiresonance has
/// little power and counts as little: what is small there does no harm.
///
/// @param least  in [0, 1]; usual: 0.8
/// Shape   lines of the set. Where no coherence is known all lines are used, and it is NaN
/// Units   none
/// Errors  throws std::invalid_argument: no response, other numbers of lines, least out of range
/// Source  Bendat & Piersol, Random Data (4th ed., 2010), sec. 6.1; the mean: ours
CoherentLines coherent_lines(const std::vector<FrequencyResponse>& set, double least = 0.8);

}  // namespace rvbench::analysis
