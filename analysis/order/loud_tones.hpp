#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "analysis/order/order_lines.hpp"

namespace rvbench::analysis {

/// A channel without the tones that carry a tenth of its power or more and are no line of its
/// gears: a hum, a neighbour, an inverter. Where the speed wanders, a tone that is fixed in Hz
/// smears over the lines of the gears around it; where it makes no whole number of turns in the
/// record, its skirts reach over all of them.
///
/// A tone is fixed in Hz if it is narrower there than over the shaft's angle; else it follows the
/// shaft, and goes where no gear has a line so near. The louder go first, eight at the most.
///
/// @param lines       of the channel
/// @param sound       orders that a sound machine has, ascending: a tone on one of them stays
/// @param from_gears  how far an order is from the nearest that a gear may have, in orders
/// @return nothing where there are none
/// Source  ours; of the frequency between two lines place_of_tone()
std::optional<Channel> without_loud_tones(const Channel& x, const ShaftAngle& angle,
                                          const OrderLines& lines, const std::vector<double>& sound,
                                          const std::function<double(double order)>& from_gears);

}  // namespace rvbench::analysis
