#pragma once

#include <filesystem>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {

/// Runs a line of bash in `folder`.
Answer bash(const std::filesystem::path& folder, const std::string& line);

/// rvbench as `cmake --install` puts it below a folder of its own.
class Installed {
 public:
  Installed();
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  /// @throws std::runtime_error if there is no such file
  std::string text_of(const std::string& name) const;

 private:
  ScratchFolder folder_;
};

}  // namespace rvbench::test
