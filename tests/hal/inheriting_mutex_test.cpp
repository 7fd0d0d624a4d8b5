#include "hal/inheriting_mutex.hpp"

#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <future>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "hal/real_time.hpp"

using rvbench::hal::InheritingMutex;

namespace {

// Of a thread, as the scheduler sees it now: below 0 is real time, by what it inherited, too.
// Source: proc(5), field 18 of stat.
long priority_of(int thread) {
  std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int field = 3; field < 18; ++field) fields >> skipped;
  long priority = 0;
  fields >> priority;
  return priority;
}

}  // namespace

TEST_CASE("a mutex that inherits is a mutex", "[hal][safety]") {
  InheritingMutex mutex;
  long count = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int round = 0; round < 10'000; ++round) {
          const std::lock_guard lock(mutex);
          ++count;
        }
      });
    }
  }
  CHECK(count == 40'000);
  const std::lock_guard lock(mutex);
  CHECK_FALSE(std::async(std::launch::async, [&] { return mutex.try_lock(); }).get());
}

TEST_CASE("whoever holds the mutex is as urgent as whoever waits for it", "[hal][safety]") {
  InheritingMutex mutex;
  std::unique_lock lock(mutex);
  REQUIRE(priority_of(::gettid()) >= 0);
  std::string without;
  std::atomic<bool> is_about_to_wait = false;
  std::jthread urgent([&] {
    without = rvbench::hal::make_this_thread_urgent();
    is_about_to_wait = true;
    is_about_to_wait.notify_all();
    const std::lock_guard waits(mutex);
  });
  is_about_to_wait.wait(false);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (without.empty() && priority_of(::gettid()) >= 0 &&
         std::chrono::steady_clock::now() < until) {
    std::this_thread::yield();
  }
  const long inherited = priority_of(::gettid());
  lock.unlock();
  urgent.join();
  CHECK(priority_of(::gettid()) >= 0);
  if (!without.empty()) {
    WARN("without the right to SCHED_FIFO nobody is more urgent than others: " << without);
  } else {
    CHECK(inherited < 0);
  }
}
