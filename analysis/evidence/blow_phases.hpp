#pragma once

#include <vector>

#include "analysis/evidence/gear_places.hpp"
#include "analysis/order/order_lines.hpp"

namespace rvbench::analysis {

/// Tells a blow from the pitch errors of sound teeth. Both fill the comb of a gear's turn; a blow
/// lasts a small part of the turn, so it aligns the phases of the lines. The measure is the
/// kurtosis of the lines' sum over one turn. It is held against random phases of the same
/// amplitudes a: their mean is 3 - 1.5·Σa⁴/(Σa²)², and some draws tell their scatter.
///
/// Shape   one per signature; NaN for a part that does not strike, or that has fewer than
///         `fewest_phases` lines at multiples of its turn
/// Units   standard deviations of random phases: 0 on average for these, and above 3 once in a
///         hundred; a housing that rings longer than a turn leaves little of a blow
/// Source  Stewart, Some useful data analysis techniques for gearbox diagnostics (ISVR, 1977): FM4;
///         the reference to random phases is ours
std::vector<double> blow_phases(const OrderLines& lines, const GearPlaces& places,
                                const Kinematics& kinematics);

inline constexpr int fewest_phases = 12;

}  // namespace rvbench::analysis
