#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "bench/cli.hpp"

namespace rvbench::bench::test {

/// What a command came to, run inside this process.
struct Answer {
  int code = -1;
  std::string out;
  std::string err;
};

inline Answer rvbench(const std::vector<std::string>& arguments) {
  std::ostringstream out;
  std::ostringstream err;
  Console console{out, err};
  const int code = run_cli(arguments, make_commands(), console);
  return {code, out.str(), err.str()};
}

}  // namespace rvbench::bench::test
