#include "bench/out_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace rvbench::bench {

OutFolder::~OutFolder() {
  std::error_code holds_something;
  for (const std::filesystem::path& folder : made_) {
    std::filesystem::remove(folder, holds_something);
  }
}

std::string OutFolder::make(const std::filesystem::path& folder,
                            const std::vector<std::string>& unheld) {
  std::error_code unusable;
  for (std::filesystem::path missing = folder;
       !missing.empty() && !std::filesystem::exists(missing, unusable);
       missing = missing.parent_path()) {
    made_.push_back(missing);
  }
  unusable.clear();
  std::filesystem::create_directories(folder, unusable);
  if (unusable) return unusable.message();
  if (access(folder.c_str(), W_OK | X_OK) != 0) return std::generic_category().message(errno);
  for (const std::string& name : unheld) {
    if (std::filesystem::exists(folder / name)) {
      return "holds a " + name + " already: give another folder";
    }
  }
  return "";
}

}  // namespace rvbench::bench
