#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <variant>

namespace rvbench::test {

/// What could be told; a test fails with the reason where it could not.
template <typename T>
T told(std::variant<T, std::string> answer) {
  if (const auto* why = std::get_if<std::string>(&answer)) FAIL(*why);
  return std::get<T>(std::move(answer));
}

}  // namespace rvbench::test
