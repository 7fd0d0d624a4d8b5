#pragma once

#include <Eigen/Core>
#include <limits>

#include "analysis/frf/force_pulse.hpp"
#include "analysis/frf/frf_record.hpp"

namespace rvbench::analysis {

/// What a hit is multiplied by before it is transformed.
struct HitWindows {
  double force_widths = 2;  ///< force beyond the pulse's ends that is kept, in widths of the pulse
  double decay_s = std::numeric_limits<double>::infinity();  ///< of the exponential window, > 0
};

/// One around the pulse, zero far from it, half a cosine of a pulse's width in between: keeps what
/// the hammer did and drops what its cable hummed.
/// Shape   n samples, 0 to 1. Units  none
/// Errors  throws std::invalid_argument: widths not above 0
/// Source  Halvorsen & Brown, Sound & Vibration 11(11), 8-21 (1977)
Eigen::VectorXd force_window(const ForcePulse& pulse, Eigen::Index n, double widths);

/// exp(-t/decay) from the first sample on; ones if decay_s is infinite.
/// Shape   n samples. Units  none
/// Errors  throws std::invalid_argument: decay or rate not above 0
/// Source  Fladung & Rost, Proc. 15th IMAC, 1566-1572 (1997)
Eigen::VectorXd exponential_window(Eigen::Index n, double rate_Hz, double decay_s);

/// The record of one hit without what rests before it, force in its window, all in the exponential
/// one.
///
/// Since the force is weighted like the responses, the FRF of the result is the true one taken at
/// jω + 1/decay: each pole moves by exactly 1/decay to the left, no more is changed.
///
/// Shape   that of the record. Units  of the record
/// Errors  throws std::invalid_argument: not one excitation, a sample not finite
/// Source  Ewins, Modal Testing (2nd ed., 2000), sec. 3.7, 3.9
FrfRecord windowed_hit(const FrfRecord& record, const HitWindows& windows);

/// Damping ratio of a mode without what the exponential window added to it: with σ = ζω and the
/// pole at -σ ± jω√(1-ζ²), σ loses 1/decay. Negative where the window explains more than all.
/// Units   Hz, s. Errors  throws std::invalid_argument: frequency or decay not above 0
/// Source  windowed_hit()
double damping_without_window(double damping_ratio, double frequency_Hz, double decay_s);

}  // namespace rvbench::analysis
