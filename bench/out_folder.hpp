#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rvbench::bench {

/// The folder that --out names. It is made before the work, so that what cannot be written is known
/// before; where nothing came of the work, what was made of folders is gone again with this object.
class OutFolder {
 public:
  OutFolder() = default;
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

  /// Makes it, with the folders above it that are missing.
  /// @param unheld  files that it must not hold: an older answer is not written over
  /// @return why it cannot be used; empty if it can
  std::string make(const std::filesystem::path& folder, const std::vector<std::string>& unheld);

 private:
  std::vector<std::filesystem::path> made_;  ///< innermost first
};

}  // namespace rvbench::bench
