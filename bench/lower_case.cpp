#include "bench/lower_case.hpp"

#include <algorithm>

namespace rvbench::bench {

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

}  // namespace rvbench::bench
