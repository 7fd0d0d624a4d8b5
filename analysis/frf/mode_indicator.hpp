#pragma once

#include <Eigen/Core>
#include <vector>

#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// Complex mode indicator function: singular values of the matrix of responses, line by line. The
/// largest peaks at every mode, the second where two modes lie together.
///
/// Shape   lines x min(responses' places, excitations' places). Where not every pair of places was
///         measured, the responses are one column: one singular value, their norm
/// Units   of the responses
/// Errors  throws std::invalid_argument: no response, another first line, step or number of lines
///         than the first one's. A line where a value is not finite is NaN
/// Source  Shih, Tsuei, Allemang & Brown, Mech. Syst. Signal Process. 2(4), 367-377 (1988)
Eigen::MatrixXd mode_indicator(const std::vector<FrequencyResponse>& responses);

}  // namespace rvbench::analysis
