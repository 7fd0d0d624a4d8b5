#pragma once

#include <string>
#include <vector>

namespace rvbench {

/// A file of the source tree that is built into the program, so that it needs no install path.
/// CMake's rvbench_embed() writes the function that returns a list of them.
struct EmbeddedFile {
  std::string name;  ///< without folder and extension: "healthy"
  std::string text;
};

}  // namespace rvbench
