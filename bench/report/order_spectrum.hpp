#pragma once

#include <Eigen/Core>

#include "analysis/spectrum.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// Amplitude spectrum of `x`, sampled at the times of `like`, over orders of the input shaft: x is
/// resampled to equal steps of the measured angle, or of the mean speed if there is no angle.
///
/// Shape   x: as many samples as `like`; resolution = 1 / whole turns recorded; Hann window
/// Units   that of x, 0-to-peak; the mean is taken out first
/// Errors  throws std::invalid_argument if neither angle nor speed is known, or for less than a
/// turn
analysis::Spectrum order_spectrum(const Eigen::VectorXd& x, const Channel& like,
                                  const Recording& recording);

}  // namespace rvbench::bench
