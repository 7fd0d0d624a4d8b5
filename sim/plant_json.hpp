#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

using PlantOrFaults = std::variant<PlantSpec, std::vector<hal::ConfigFault>>;

/// Reads a plant file.
///
/// Quantities are {"value", "unit", "tolerance_pct"}: 0 (the default) says the value is exact,
/// "free" that it is to be identified. The unit must be the one that the body's motion asks for.
/// @return the plant, or every fault of the file
PlantOrFaults parse_plant(hal::ConfigReader root, const TermLibrary& library = standard_terms());

/// A shipped plant ("emps", "rv20e_bench", "silverbox", "ur10e_joint"), or one from a path.
PlantOrFaults read_plant(const std::string& name_or_path,
                         const TermLibrary& library = standard_terms());

/// As a plant file, with every default spelled out: it reads back to the same plant.
std::string write_plant(const PlantSpec& plant, const TermLibrary& library = standard_terms());

}  // namespace rvbench::sim
