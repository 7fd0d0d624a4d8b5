#pragma once

#include <chrono>
#include <thread>

namespace rvbench::test {

/// As long as a busy computer may need for what takes milliseconds on an idle one: no test of
/// speed.
inline constexpr std::chrono::seconds patience{30};

/// Waits in real time for what another thread or process does.
/// @param met  asked every millisecond, once more after the last wait
/// @return false if it has not come in time
template <typename Met>
[[nodiscard]] bool wait_until(Met met, std::chrono::duration<double> limit = patience) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!met()) {
    if (std::chrono::steady_clock::now() >= end) return met();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace rvbench::test
