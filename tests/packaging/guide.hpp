#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rvbench::test {

/// How a guide's command is meant.
enum class Kind {
  now,     ///< ```sh: runs here, and ends with `code`
  beside,  ///< ```sh beside: in a terminal of its own, until the guide's end
  by_hand  ///< ```sh by-hand: needs devices, rights or minutes
};

/// A line of a guide's blocks of sh.
struct GuideLine {
  Kind kind = Kind::now;
  std::string command;
  int code = 0;  ///< of a comment at its end: # exit code 10
};

/// All of them, in order; a line that ends in a backslash goes on in the next.
/// @throws std::runtime_error if a block is of another kind, or does not end
std::vector<GuideLine> guide_lines(const std::string& text);

/// Options of rvbench in this command that it does not have; "" if there are none, or if it calls
/// something else.
std::string unknown_words(const std::string& command);

}  // namespace rvbench::test
