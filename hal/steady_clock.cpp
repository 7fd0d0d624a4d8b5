#include "hal/steady_clock.hpp"

#include <thread>

namespace rvbench::hal {

double SteadyClock::now_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void SteadyClock::wait_until(double time_s) {
  // Rounded up: a wait that ends a nanosecond early would break the promise.
  std::this_thread::sleep_until(
      start_ + std::chrono::ceil<std::chrono::nanoseconds>(std::chrono::duration<double>(time_s)));
}

}  // namespace rvbench::hal
