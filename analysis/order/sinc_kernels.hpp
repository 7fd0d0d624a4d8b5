#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// The inner loop of a SincInterpolator, for one kind of processor: the same to rounding on all.
///
/// Units   those of x. Errors  none thrown. Source  ours
struct SincKernels {
  /// Σ x[tap]·((1 − weight)·below[tap] + weight·above[tap]) over an even number of taps.
  double (*between)(const double* x, const double* below, const double* above, double weight,
                    Eigen::Index taps);
};

/// For any processor.
const SincKernels& portable_sinc_kernels();
/// For this one.
const SincKernels& sinc_kernels();

}  // namespace rvbench::analysis
