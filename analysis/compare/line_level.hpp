#pragma once

#include <optional>

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// p-value up to which a line is seen.
inline constexpr double seen_p = 1e-4;

/// Power of a tone, and how surely there is one.
struct LineLevel {
  double power = 0;        ///< amplitude², 0-to-peak
  double above_floor = 0;  ///< of its highest line, over the power of the noise around
  double p_value = 1;      ///< that noise alone reaches that, anywhere within reach
};

/// Power at an order of a Hann spectrum: of the strongest three neighbouring lines whose middle
/// lies within reach.
///
///     P = (A²₋₁ + A²₀ + A²₊₁) / 1.5
///
/// Where more than one line is within reach, the noise is that of the nearest 60 to both sides if
/// that is more: a resonance is no line.
///
/// Shape   of a tone on a line its amplitude², of one between two lines at most 0.4 dB less
/// Units   orders; amplitude of the spectrum squared
/// @param floor   of the same spectrum
/// @param blocks  independent ones that the spectrum is the mean of, in power; >= 1
/// @param within  orders to both sides
/// @param searched  the same, of the search that led to `order`: noise had a chance anywhere there
/// @return empty where the spectrum does not reach, or too near to order 0
/// Errors  none thrown
/// Source  1.5 lines is the noise bandwidth of the Hann window: Harris, Proc. IEEE 66(1), 51-83
///         (1978), table 1
std::optional<LineLevel> line_level(const Spectrum& spectrum, const LineFloor& floor, double blocks,
                                    double order, double within, double searched = 0);

/// Power of the strongest single line within reach, of a spectrum without a window; empty as above.
/// Units, errors  of line_level(). Source  ours: a line that is locked to the record has one line
std::optional<double> single_line_power(const Spectrum& spectrum, double order, double within);

}  // namespace rvbench::analysis
