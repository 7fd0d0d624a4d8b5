#pragma once

#include <vector>

#include "hal/config_reader.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

/// What stands in the way of simulating this plant: names that nobody has, numbers out of bounds,
/// units that do not fit, gates not kept. Empty if nothing does; lines are 0.
std::vector<hal::ConfigFault> check_plant(const PlantSpec& plant,
                                          const TermLibrary& library = standard_terms());

/// Unit of the factor from `from` to `to`: "1", "V/N", "A/(N·m)".
std::string gain_unit(std::string_view to, std::string_view from);

}  // namespace rvbench::sim
