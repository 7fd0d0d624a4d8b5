#include "tests/spec/rvbench.hpp"

#include "tests/support/this_build.hpp"

namespace rvbench::test {

const std::string& rvbench_path() {
  static const std::string path = build_dir() / "rvbench";
  return path;
}

Answer rvbench(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{rvbench_path()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return Program(folder, words).wait();
}

}  // namespace rvbench::test
