#pragma once

#include <Eigen/Core>

#include "analysis/envelope/tested_spectrum.hpp"

namespace rvbench::analysis {

struct CoherenceOptions {
  double highest = 0;  ///< cyclic frequency, in the unit of the rate; > 0
  int bands = 64;      ///< that the spectrum is parted into, below half the rate less `highest`
};

/// Squared magnitude of the spectral coherence: for each band, how far what is in it repeats in
/// what is a cyclic frequency above it. 0 if power does not swing at that frequency, 1 if it does
/// nothing else. Units are those of the rate: Hz, or orders for samples per turn.
struct SpectralCoherence {
  double resolution = 0;    ///< from column to column: 1 over the duration
  double first = 0;         ///< lower edge of the first band
  double width = 0;         ///< of a band
  Eigen::MatrixXd squared;  ///< bands x cyclic lines 0, 1, ...; line 0 is 1

  /// Independent spectral lines that a band is worth: in stationary noise |γ|² is 1/lines in the
  /// mean, and exceeds c with probability (1 - c)^(lines - 1).
  double lines = 0;
};

/// Spectral coherence, averaged over the lines X of each band, under a Hann window:
///
///     |γ(α, f)|² = |Σ X(f + α)·X*(f)|² / (Σ |X(f + α)|² · Σ |X(f)|²)
///
/// on every cyclic line up to the highest, as exact as one by one: the sums over a band are a
/// correlation of its lines with those above, taken by FFT.
///
/// Shape   N samples → options.bands x (highest·N/rate + 1)
/// Limits  lines 1 and 2 are the window's; the null is that of noise which is white within a band:
///         whiten before (floor_whitened). Two tones of one machine, a cyclic frequency apart, are
///         coherent by that alone: take them out before if strikes are looked for
///         (cepstrum_prewhitened)
/// Errors  throws std::invalid_argument: sample not finite, rate or highest not positive, fewer
///         than 16 lines in a band
/// Source  Gardner, IEEE Trans. Acoust. Speech Signal Process. 34(5), 1111-1123 (1986): frequency
///         smoothing; Antoni, Xin & Hamzaoui, Mech. Syst. Signal Process. 92, 248-277 (2017)
SpectralCoherence spectral_coherence(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                                     const CoherenceOptions& options);

/// Enhanced envelope spectrum: root of the mean of |γ|² over all bands, on each cyclic line.
///
/// Noise of a line is what stationary noise shows, or what is around the line if that is more: what
/// swings without a period raises the coherence at all frequencies, and in many bands at once: how
/// far its lines then scatter is measured, best with some hundreds of cyclic lines. Lines 0 to 2,
/// which are the window's, are 0.
/// Shape, units  as many lines as the coherence has, of its unit; amplitude without. Errors  none
/// Source  Antoni, Xin & Hamzaoui, Mech. Syst. Signal Process. 92, 248-277 (2017); the null is ours
TestedSpectrum enhanced_envelope_spectrum(const SpectralCoherence& coherence);

/// Improved envelope spectrum: the same over the bands whose middle is in [from, to).
/// Shape, units  of enhanced_envelope_spectrum(); from and to in the unit of the rate
/// Errors  throws std::invalid_argument: no band is
/// Source  Mauricio, Smith, Randall, Antoni & Gryllias, Mech. Syst. Signal Process. 144, 106891
///         (2020)
TestedSpectrum improved_envelope_spectrum(const SpectralCoherence& coherence, double from,
                                          double to);

}  // namespace rvbench::analysis
