#include "hal/types/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

using rvbench::parallel_for;

namespace {

// How many threads are inside at once, at most.
class Crowd {
 public:
  void visit() {
    const unsigned now = ++inside_;
    unsigned most = most_;
    while (now > most && !most_.compare_exchange_weak(most, now)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --inside_;
  }
  unsigned most() const { return most_; }

 private:
  std::atomic<unsigned> inside_{0}, most_{0};
};

}  // namespace

TEST_CASE("each index is visited once, by however many threads", "[hal][threads]") {
  for (const unsigned threads : {0U, 1U, 3U, 16U}) {
    std::vector<int> visits(100, 0);
    parallel_for(
        visits.size(), [&](std::size_t i) { ++visits[i]; }, threads);
    CHECK(std::ranges::all_of(visits, [](int count) { return count == 1; }));
  }
}

TEST_CASE("calls within calls share the cores", "[hal][threads]") {
  Crowd crowd;
  parallel_for(8, [&](std::size_t) {
    parallel_for(8, [&](std::size_t) { parallel_for(4, [&](std::size_t) { crowd.visit(); }); });
  });
  CHECK(crowd.most() >= 1);
  CHECK(crowd.most() <= std::max(1U, std::thread::hardware_concurrency()));
  AND_THEN("they are free again for the next") {
    Crowd next;
    parallel_for(64, [&](std::size_t) { next.visit(); });
    CHECK(next.most() == std::min(64U, std::max(1U, std::thread::hardware_concurrency())));
  }
}

TEST_CASE("the failure of the lowest index is told, once all are done", "[hal][threads]") {
  std::atomic<int> done = 0;
  const auto fail = [&](std::size_t i) {
    ++done;
    if (i == 3) throw std::runtime_error("three");
    if (i == 7) throw std::runtime_error("seven");
  };
  CHECK_THROWS_WITH(parallel_for(20, fail), "three");
  CHECK(done == 20);
}
