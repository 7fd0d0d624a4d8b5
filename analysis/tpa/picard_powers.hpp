#pragma once

#include "analysis/tpa/line_svd.hpp"
#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// Those of one line.
///
/// @param responses  rows x records, complex amplitudes at that line
/// Errors  throws std::invalid_argument: no such line, other rows than the decomposition's, no
///         record, a value that is not finite, a line whose singular values are all 0
/// Source  Hansen, Discrete Inverse Problems (2010), ch. 3: the Picard condition
PicardPowers picard_powers(const LineSvd& svd, Eigen::Index line,
                           const Eigen::Ref<const Eigen::MatrixXcd>& responses);

}  // namespace rvbench::analysis
