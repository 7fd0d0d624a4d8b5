#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rvbench::hal::formats {

/// What is wrong with the structure of a MAT v5 file, with the variable or the byte of the place;
/// nothing if every element lies within the one around it and every array has as many values as
/// its size says. A file that passes can be handed to a reader that believes the sizes it finds.
///
/// Source  "MAT-File Format", The MathWorks, level 5
/// Limits  sparse arrays, objects and function handles are refused; a compressed variable may
///         inflate to 1 GiB
std::optional<std::string> find_mat5_fault(std::string_view file);

}  // namespace rvbench::hal::formats
