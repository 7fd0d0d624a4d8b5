#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/evidence/own_lines.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/order/order_lines.hpp"

namespace rvbench::analysis {

/// What a channel hears beside its gears, and how its power comes and goes with the shaft.
struct ResidualEnvelope {
  double resolution = 0;      ///< orders per line
  double order_error = 0;     ///< relative: how far orders may be off, where no angle was measured
  LineFloor lines;            ///< squared envelope over its mean, as squared depths; 0-to-peak
  std::vector<bool> locked;   ///< one flag per line of it: on the gear train's
  Spectrum windowed;          ///< the same under a Hann window, as depths: for the locked lines
  double residual2 = 0;       ///< mean square of what is left without the gears' lines
  double left = 1;            ///< share of the lines that are left
  double gears2 = 0;          ///< mean square of these
  Eigen::VectorXcf residual;  ///< lines of what is left: the sum of their squares is residual2
};

/// Lines that the squared envelope of a channel has; 0 where it has too few to tell anything.
/// @param turns, top_order  of the channel  @param highest_order  that is asked for
Eigen::Index envelope_lines(double turns, double top_order, double highest_order);

/// Where the gear train's lines are in a channel's transform and in its squared envelope, the same
/// for all channels that span the same turns.
struct ResidualPlaces {
  bool is_periodic = false;  ///< every turn goes into the record a whole number of times
  std::vector<bool> gears;   ///< one flag per line of the transform
  std::vector<bool> locked;  ///< one flag per line of the envelope; empty: it has too few
};

/// @param turns, top_order  of the channel  @param highest_order  that is asked for
/// Units  orders of the input shaft
ResidualPlaces residual_places(double turns, double top_order, const Kinematics& kinematics,
                               double highest_order);

/// The lines of the gear train are taken out, what is left is divided by its own level around each
/// line, and the analytic signal squared. A tone is then one line among many, and no resonance
/// drowns another.
///
/// A record over whole periods of the gear train has its lines on single lines of the transform. Of
/// other gear trains the lines fall between, and a Hann window keeps them apart.
///
/// Shape   as many lines as places.locked; none where the record has fewer than 64
/// Units   orders of the input shaft; mean squares in the square of the channel's unit
/// Source  Antoni & Randall, Mech. Syst. Signal Process. 18(1), 103-117 (2004): what is random
///         beside what is periodic; Borghesani et al., Mech. Syst. Signal Process. 36(2), 370-384
///         (2013): whitening before the squared envelope; the local level is ours
ResidualEnvelope residual_envelope(const OrderLines& x, const ResidualPlaces& places);

}  // namespace rvbench::analysis
