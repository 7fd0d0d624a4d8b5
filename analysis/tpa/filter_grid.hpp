#pragma once

#include "analysis/tpa/line_matrices.hpp"

namespace rvbench::analysis {

/// Lines of frequency as samples of a discrete Fourier transform: line k of the matrices is line
/// first + k of `length` samples.
struct FilterGrid {
  Eigen::Index length = 0;
  Eigen::Index first = 0;
};

/// Whether rate and first line are multiples of the step, to 1e-6 of it.
/// Units  Hz. Errors  none thrown. Source  definition
bool has_filter_grid(double first_Hz, double step_Hz, double rate_Hz);

/// @throws std::invalid_argument in the name of `where` if there is none, or a line lies above
///         half the rate
FilterGrid filter_grid(const char* where, const LineMatrices& lines, double first_Hz,
                       double step_Hz, double rate_Hz);

}  // namespace rvbench::analysis
