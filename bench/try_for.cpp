#include "bench/try_for.hpp"

#include <future>
#include <thread>
#include <utility>

namespace rvbench::bench {

bool try_for(std::chrono::seconds longest, const std::function<void()>& work) noexcept {
  try {
    std::packaged_task<void()> task(work);
    const std::future<void> done = task.get_future();
    std::thread(std::move(task)).detach();
    return done.wait_for(longest) == std::future_status::ready;
  } catch (...) {  // no thread is to be had: without, it might wait for ever
    return false;
  }
}

}  // namespace rvbench::bench
