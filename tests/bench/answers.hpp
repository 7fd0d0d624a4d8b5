#pragma once

#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "bench/cli.hpp"

namespace rvbench::test {

/// What a command came to, run inside this process.
struct CommandAnswer {
  int code = -1;
  std::string out;
  std::string err;
};

inline CommandAnswer answer_of(const std::vector<std::string>& arguments,
                               const std::vector<std::unique_ptr<bench::Command>>& commands) {
  std::ostringstream out;
  std::ostringstream err;
  bench::Console console{out, err};
  const int code = bench::run_cli(arguments, commands, console);
  return {code, out.str(), err.str()};
}

inline CommandAnswer rvbench(const std::vector<std::string>& arguments) {
  return answer_of(arguments, bench::make_commands());
}

/// `rvbench limits` by an engineer, on the results below this folder.
inline CommandAnswer limits(const std::filesystem::path& root, std::vector<std::string> words) {
  words.insert(words.begin(), "limits");
  words.insert(words.end(), {"--by", "J. Weber", "--out", root.string()});
  return rvbench(words);
}

}  // namespace rvbench::test
