#pragma once

#include <Eigen/Core>

#include "analysis/order/over_angle.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// Order spectra of a record, block by block.
struct OrderMap {
  double resolution = 0;      ///< orders per line
  Eigen::MatrixXd amplitude;  ///< lines by blocks; 0-to-peak, in the unit of the signal
  Eigen::VectorXd time_s;     ///< when the shaft stood at the middle of each block
  Eigen::VectorXd speed_Hz;   ///< mean speed of the shaft during each block
};

/// Hann spectra of blocks of so many turns, each half a block after the last: what belongs to the
/// shaft stays on its line when the speed changes, what does not (a resonance, mains) crosses.
///
/// Shape    N samples → (block samples / 2 + 1) lines by floor(2·(turns / block_turns) − 1) blocks;
///          no block if not one fits
/// Units    that of the samples; orders; s on the clock of `angle`; turns/s
/// Errors   throws std::invalid_argument: block_turns below 1, less than 4 samples in a block, a
///          sample not finite
/// Source   Fyfe & Munck, Mech. Syst. Signal Process. 11(2), 187-205 (1997)
OrderMap order_map(const OverAngle& x, const ShaftAngle& angle, int block_turns);

}  // namespace rvbench::analysis
