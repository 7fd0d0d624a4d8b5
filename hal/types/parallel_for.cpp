#include "hal/types/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace rvbench {
namespace {

// Threads at work in all calls together, beside the ones that called: where calls stand in one
// another, they share the cores.
std::atomic<unsigned> at_work{0};

bool take_one(unsigned cores) {
  unsigned now = at_work;
  while (now + 1 < cores) {
    if (at_work.compare_exchange_weak(now, now + 1)) return true;
  }
  return false;
}

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body,
                  unsigned threads) {
  const bool as_many_as_free = threads == 0;
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  if (as_many_as_free) threads = cores;
  threads = static_cast<unsigned>(std::min<std::size_t>(threads, count));

  std::vector<std::exception_ptr> failures(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t) {
      if (as_many_as_free && !take_one(cores)) break;
      try {
        others.emplace_back([&] {
          work();
          if (as_many_as_free) --at_work;
        });
      } catch (const std::system_error&) {  // no more threads: these do it all
        if (as_many_as_free) --at_work;
        break;
      }
    }
    work();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace rvbench
