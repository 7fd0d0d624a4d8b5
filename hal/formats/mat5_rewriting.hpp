#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rvbench::hal::formats::mat5 {

/// Checks a variable and, if asked, writes it anew as it is read: text in UTF-16, names of fields
/// in an element of their own, and nothing in place of a member that is not read.
///
/// @param bytes      of the variable's element
/// @param swapped    written by a machine of the other order of bytes, in which it is written anew
/// @param leave_out  is told what of it is not read: "f (function handle)"
/// @param out        where it is written behind what is there; null: it is checked, nothing is told
/// @return whether it is of a kind that is read
/// @throws Fault naming the variable
bool write_variable(std::string_view bytes, bool swapped,
                    const std::function<void(std::string what)>& leave_out, std::string* out);

}  // namespace rvbench::hal::formats::mat5
