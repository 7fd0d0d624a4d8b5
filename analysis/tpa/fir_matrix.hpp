#pragma once

#include <Eigen/Core>

#include "analysis/tpa/line_matrices.hpp"

namespace rvbench::analysis {

/// Impulse responses between all inputs and all outputs at one sample rate.
struct FirMatrix {
  Eigen::Index outputs = 0;
  Eigen::Index inputs = 0;
  double rate_Hz = 0;
  double delay_samples = 0;  ///< by which outputs come late, on purpose
  Eigen::MatrixXd taps;      ///< taps x outputs·inputs; column output·inputs + input

  auto response(Eigen::Index output, Eigen::Index input) const {
    return taps.col(output * inputs + input);
  }
  auto response(Eigen::Index output, Eigen::Index input) {
    return taps.col(output * inputs + input);
  }
};

/// What the filters do to lines 0 ... n/2 of n samples, with their delay: outputs x inputs per
/// line. Errors  throws std::invalid_argument: n below the number of taps. Source  definition
LineMatrices frequency_response(const FirMatrix& filters, Eigen::Index n);

}  // namespace rvbench::analysis
