#pragma once

#include <chrono>
#include <functional>

namespace rvbench::bench {

/// How late it is [s], for what is shown to people: from any moment on, and never back.
using SecondsSource = std::function<double()>;

inline double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace rvbench::bench
