#pragma once

#include <sstream>
#include <string>

#include "bench/summary.hpp"

namespace rvbench::test {

/// What is printed of a judgement.
inline std::string summary_of(const bench::Judgement& judgement) {
  std::ostringstream out;
  bench::Console console{out, out};
  bench::print_summary(console, judgement, {}, "");
  return out.str();
}

}  // namespace rvbench::test
