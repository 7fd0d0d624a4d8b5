#include "tests/support/this_build.hpp"

#include <fstream>
#include <stdexcept>

namespace rvbench::test {

namespace {

std::filesystem::path find_build_dir() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  for (auto folder = program.parent_path(); folder != folder.parent_path();
       folder = folder.parent_path()) {
    if (std::filesystem::exists(folder / "CMakeCache.txt")) return folder;
  }
  throw std::runtime_error("no CMakeCache.txt above " + program.string());
}

}  // namespace

const std::filesystem::path& build_dir() {
  static const std::filesystem::path folder = find_build_dir();
  return folder;
}

std::string build_setting(const std::string& name) {
  std::ifstream cache(build_dir() / "CMakeCache.txt");
  // "NAME:TYPE=value"
  for (std::string line; std::getline(cache, line);) {
    if (line.starts_with(name + ":")) return line.substr(line.find('=') + 1);
  }
  throw std::runtime_error("CMakeCache.txt has no " + name);
}

const std::filesystem::path& source_dir() {
  static const std::filesystem::path folder = build_setting("CMAKE_HOME_DIRECTORY");
  return folder;
}

}  // namespace rvbench::test
