#pragma once

#include <vector>

#include "analysis/order/over_angle.hpp"

namespace rvbench::analysis {

/// One way in which a carrier swings.
struct Modulation {
  double spacing = 0;       ///< of the sidebands from the carrier, in orders
  int multiple = 1;         ///< 2, 3 ... if it is a harmonic of another spacing that was found
  double am_depth = 0;      ///< swing of the amplitude over its mean, 0-to-peak
  double pm_index_rad = 0;  ///< swing of the phase, 0-to-peak
  double am_error = 0;      ///< standard errors, from the noise around
  double pm_error_rad = 0;
  double am_p_value = 1;  ///< of noise alone making such a swing at any spacing of the search
  double pm_p_value = 1;
  double lower = 0;  ///< amplitudes of the sidebands themselves, in the unit of the signal
  double upper = 0;
};

/// A line and what modulates it.
struct Sidebands {
  double carrier_order = 0;       ///< as found; 0: no line stands there
  double carrier_amplitude = 0;   ///< mean, 0-to-peak, in the unit of the signal
  double carrier_over_noise = 0;  ///< power, over that of the noise within reach
  bool first_order = false;       ///< the line fades at times: swings were told from its sidebands
  double resolution = 0;          ///< orders between two lines of the modulation's spectra
  std::vector<Modulation> modulations;  ///< swings with am or pm p-value below 1e-3, deepest first
};

/// Where a carrier is, and how far from it modulation is looked for.
struct SidebandSearch {
  double carrier_order = 0;
  double reach_order = 0;  ///< less than half the way to the next carrier
};

/// Finds the sidebands around a carrier, whatever their spacing, and tells swings of its amplitude
/// from swings of its phase: the carrier is turned back to order 0, with all that lies within
/// reach_order, and modulus and phase of what is left have each a spectrum with its own floor.
///
///     x(θ) = A·(1 + m·cos(sθ + α))·cos(cθ + β·cos(sθ + ψ))
///
/// Where the modulus falls below a third of its mean, the phase may lose a cycle: then the swings
/// are those of what lies along the mean carrier (AM) and across it (PM), which is right to first
/// order; β²/4 of a phase swing β shows as AM at twice the spacing.
///
/// Shape    N samples over angle → any number of modulations; no carrier, no modulations
/// Units    orders; rad; that of the samples
/// Band     spacings from 2 lines of `resolution` to three quarters of reach_order; a deep phase
///          swing whose sidebands go on beyond is cut off there
/// Limits   two spacings need 4 lines between them; a swing below 1e-9 is taken for rounding
/// Errors   throws std::invalid_argument: band not within (0, half the samples per turn), less than
///          64 lines in it, a sample not finite
/// Source   McFadden, J. Vib. Acoust. 108(2), 165-170 (1986): amplitude and phase modulation of a
///          mesh line; line_floor() and line_p_value() for the significance
Sidebands sidebands_of(const OverAngle& x, const SidebandSearch& search);

}  // namespace rvbench::analysis
