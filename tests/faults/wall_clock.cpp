#include "tests/faults/wall_clock.hpp"

#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>

namespace {

std::atomic<long> step_s = 0;

}  // namespace

// The linker prefers these to the C library's, in every library that this program loads.
extern "C" {

int clock_gettime(clockid_t clock, struct timespec* time) noexcept {
  const long result = ::syscall(SYS_clock_gettime, clock, time);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) {
    time->tv_sec += step_s;
  }
  return int(result);
}

int gettimeofday(struct timeval* __restrict time, void* __restrict) noexcept {
  timespec now{};
  const int result = clock_gettime(CLOCK_REALTIME, &now);
  if (result == 0) *time = {now.tv_sec, now.tv_nsec / 1000};
  return result;
}

time_t time(time_t* to) noexcept {
  timespec now{};
  if (clock_gettime(CLOCK_REALTIME, &now) != 0) return -1;
  if (to != nullptr) *to = now.tv_sec;
  return now.tv_sec;
}

}  // extern "C"

namespace rvbench::test {

void step_wall_clock(double seconds) { step_s += std::lround(seconds); }

bool wall_clock_can_step() {
  using std::chrono::system_clock;
  constexpr auto step = std::chrono::hours(5);
  const auto steady = std::chrono::steady_clock::now();
  const auto before = system_clock::now();
  step_wall_clock(std::chrono::duration<double>(step).count());
  const auto after = system_clock::now();
  step_wall_clock(-std::chrono::duration<double>(step).count());
  const auto minute = std::chrono::minutes(1);
  return after - before >= step && after - before < step + minute &&
         std::chrono::steady_clock::now() - steady < minute;
}

}  // namespace rvbench::test
