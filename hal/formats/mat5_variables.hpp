#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rvbench::hal::formats {

/// What is done with each variable of a MAT v5 file.
struct Mat5Visitor {
  /// A variable that can be read, as a file of its own. Every element of it lies within the one
  /// around it, and every array has as many values as its size says: a reader that believes the
  /// sizes it finds can have it. Text is in UTF-16. @return why it cannot be taken
  std::function<std::optional<std::string>(const std::string& file)> take;
  /// A variable, or a part of one, that is of a kind that is not read: "f (function handle)".
  std::function<void(std::string what)> leave_out;
};

/// @return what is wrong with the structure of the file, with the variable or the byte of the place
/// Source  "MAT-File Format", The MathWorks, level 5
/// Limits  a compressed variable may inflate to 1 GiB
std::optional<std::string> visit_mat5(std::string_view file, const Mat5Visitor& visitor);

}  // namespace rvbench::hal::formats
