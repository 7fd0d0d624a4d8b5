#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/formats/uff_datasets.hpp"

namespace rvbench::hal::formats {

/// The numbers of a data set 58 behind its header lines, in their order; what is cut off, or no
/// number, at the end of a file that was cut off is left out.
///
/// @param values     what follows the header lines
/// @param first_line of `values`
/// @param is_double  8 bytes a number in 58b, else 4
/// @return the fault instead: "120: \"x\" is not a number"
std::variant<std::vector<double>, std::string> uff_numbers(const UffDataset& dataset,
                                                           std::string_view values,
                                                           std::size_t first_line, bool is_double);

}  // namespace rvbench::hal::formats
