#pragma once

#include <catch2/catch.hpp>
#include <string>

namespace rvbench::test {

/// The text with its first `from` replaced; fails where it has none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace rvbench::test
