#pragma once

#include <optional>

#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Level of a spectrum at an order: that of its highest line within reach, in the unit of its
/// amplitude. Of an envelope spectrum it is the envelope level at that order.
///
/// @param within  orders to both sides; the nearest line at least
/// @return empty where the spectrum does not reach
/// Errors  throws std::invalid_argument: order or within negative or not finite
/// Source  ours: what a limit at an order is held against
std::optional<double> level_at_order(const Spectrum& spectrum, double order, double within);

/// Sideband ratio of a mesh line: the sum of the amplitudes of its sidebands to both sides over its
/// own.
///
///     Σ (A(mesh - k·spacing) + A(mesh + k·spacing)) / A(mesh),   k = 1 .. sidebands
///
/// Units   dimensionless; m for a mesh whose amplitude swings by m at one order: one sideband of
///         m/2 to either side
/// Limits  noise counts as well: compare with that of a sound unit
/// @param sidebands  to either side; 3 as in the literature
/// @return empty where the mesh line or a sideband is outside the spectrum, or is no line of its
///         own, and where the mesh has no amplitude
/// Source  Hanna, Hatch, Kalb, Weiss & Luo, China Wind Power (2011): sideband energy ratio
std::optional<double> sideband_ratio(const Spectrum& spectrum, double mesh_order, double spacing,
                                     int sidebands = 3);

}  // namespace rvbench::analysis
