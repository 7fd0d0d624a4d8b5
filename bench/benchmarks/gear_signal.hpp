#pragma once

#include <Eigen/Core>

namespace rvbench::bench {

/// One acceleration channel of an RV reducer, the same at every call: mesh lines swung by the input
/// shaft, pin-pass lines, a bearing that strikes a 1.48 kHz resonance, drift and noise.
///
/// Units  m/s², at 4960 Hz
Eigen::VectorXd gear_signal(double duration_s);

inline constexpr double gear_signal_rate_Hz = 4960;

}  // namespace rvbench::bench
