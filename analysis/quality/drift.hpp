#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::analysis {

struct Drift {
  double change = 0;     ///< of the mean over the record, in the unit of the signal
  double vibration = 0;  ///< rms within a block, the middle one of them
};

/// A mean that moves: a charge amplifier that integrates its own leak, a sensor that warms up, an
/// IEPE supply that has not settled or was just lost.
///
/// The mean of each block of a second or more, in whole periods of the machine, is free of
/// vibration, and of the gravity that a sensor on the output feels in turning. What AC coupling
/// passes dies out within it: at a lower corner of 0.5 Hz, in 1/(2π·0.5 Hz) = 0.3 s. So a mean that
/// changes by ten times the rms of the vibration is no motion of a machine that stands in its
/// place.
///
/// Shape   at least four blocks; empty if they do not fit, or if the mean changes by less
/// Limits  found from a change of 10 rms on; a healthy channel's changes by less than the rms, pink
///         noise by about 2 rms in 10 s and 6 rms in 10 min. A smaller drift leaves orders and
///         envelopes alone: the residue takes it
/// Errors  throws std::invalid_argument: rate or period not > 0, or sample not finite
/// Units   that of x, Hz, s. Source  ours: what AC coupling lets through, as above
std::optional<Drift> find_drift(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                double period_s);

}  // namespace rvbench::analysis
