#pragma once

#include <catch2/catch.hpp>

namespace rvbench::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // GCC
inline constexpr bool under_sanitizer = true;
#elif defined(__has_feature)  // Clang
inline constexpr bool under_sanitizer =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool under_sanitizer = false;
#endif

/// True, with a warning, where a test of minutes would take hours. Only for tests whose every line
/// of code a shorter one runs, too.
inline bool too_long_under_sanitizer() {
  if (under_sanitizer) WARN("skipped: too long under a sanitizer");
  return under_sanitizer;
}

}  // namespace rvbench::test
