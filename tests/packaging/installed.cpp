#include "tests/packaging/installed.hpp"

#include <stdexcept>

#include "bench/text_file.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::test {

Answer bash(const std::filesystem::path& folder, const std::string& line) {
  return Program(folder, {"/bin/bash", "-c", line}).wait();
}

Installed::Installed() {
  const Answer answer =
      bash(folder_.path(), build_setting("CMAKE_COMMAND") + " --install " + build_dir().string() +
                               " --prefix " + folder_.path().string());
  if (answer.code != 0) throw std::runtime_error("cmake --install: " + answer.err);
}

std::string Installed::text_of(const std::string& name) const {
  const auto text = bench::read_file(folder_ / name);
  if (!text) throw std::runtime_error("not installed: " + name);
  return *text;
}

}  // namespace rvbench::test
