#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/indicators/indicator.hpp"
#include "analysis/kinematics.hpp"
#include "analysis/order/order_lines.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

struct ChannelIndicators {
  std::vector<Indicator> list;          ///< those of one measure side by side
  std::vector<GearResidual> residuals;  ///< of the gears that have one: for NA4 of later records
};

/// All indicators of one channel of vibration: levels of the whole and of order_bands(), levels at
/// locked_orders(), sideband ratio of each mesh, FM0 and FM4 of each gear.
///
/// What cannot be computed is not in the list: orders above 0.4 of the sample rate, or fewer than
/// lines_to_part from the mean or the mesh; a gear that made fewer than four turns; all but the
/// levels of the whole where the record holds no period of the gear train.
///
/// Nor, where the speed was stated and no angle measured, is a sideband ratio, FM0, FM4 or residual
/// of a mesh that is_placed() does not vouch for: it would be read off the wrong lines.
///
/// Nor is a ratio that noise would make. A mesh must be heard, and besides
///
///     sideband ratio  20 times the noise of a line (26 dB): six sidebands of noise, each √(π/4) of
///                     it on average, sum to 0.27 of such a mesh, which itself is known within 7 %
///     FM0             12 times the rms noise of the gear's average, all harmonics together: that
///                     noise swings by six times its rms over some hundred samples, and adds 0.5
///                     to the 2 of a sine
///
/// @param lines  of the channel, over periods of the kinematics
/// @param heard  the channel's spectral_lines(), which say what meshes are heard
/// Shape    N samples → any number of indicators
/// Units    levels in the unit of the channel, all others without
/// Limits   harmonics of all meshes, and the first sidebands of its own, are no fault of a gear to
///          FM4; at order_level and in a sideband, other lines of the same order count as well
/// Errors   throws std::invalid_argument: no sample, a sample is not finite
/// Source   signal_levels(), level_at_order(), sideband_ratio(), fm0(), fm4(); how far above noise
///          a mesh must be is ours: the amplitude of a line of noise is Rayleigh distributed
ChannelIndicators channel_indicators(const Channel& x, const OrderLines& lines,
                                     const Kinematics& kinematics,
                                     const std::vector<SpectralLine>& heard);

}  // namespace rvbench::analysis
