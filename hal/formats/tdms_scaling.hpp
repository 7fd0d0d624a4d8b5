#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/formats/tdms_file.hpp"

namespace rvbench::hal::formats {

/// The values of a channel in its unit: as they are stored or, where its properties NI_Scale[...]
/// say so, after these scalings (Linear, Polynomial, Table, Add, Subtract). Returns in words
/// instead why that cannot be: scalings of sensors of temperature and strain are not known here.
///
/// Table interpolates linearly and ends level. Its "pre-scaled" values are the results, and
/// Subtract takes the left operand from the right one: so do the readers of others and the maker's
/// own spreadsheet import.
std::variant<std::vector<double>, std::string> scaled_values(const TdmsChannel& channel);

/// The property of that name as a number or a text; nothing if it is not there, or of another kind.
std::optional<double> number_in(const TdmsProperties& properties, const std::string& name);
std::string text_in(const TdmsProperties& properties, const std::string& name);

}  // namespace rvbench::hal::formats
