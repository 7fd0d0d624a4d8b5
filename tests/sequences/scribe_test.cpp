#include "sequences/scribe.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

using rvbench::sequences::Scribe;

TEST_CASE("a scribe does jobs one after the other, in the order they came", "[sequences]") {
  std::vector<int> done;
  {
    Scribe scribe(1000);
    for (int i = 0; i < 100; ++i) REQUIRE(scribe.post(1, [&done, i] { done.push_back(i); }));
    scribe.finish();
    CHECK(done.size() == 100);
    CHECK_FALSE(scribe.is_busy());
    REQUIRE(scribe.post(1, [&done] { done.push_back(100); }));
  }  // as finish()
  REQUIRE(done.size() == 101);
  for (int i = 0; i <= 100; ++i) CHECK(done[std::size_t(i)] == i);
}

TEST_CASE("a scribe that has fallen too far behind says so instead of filling the memory",
          "[sequences]") {
  std::promise<void> go_on;
  Scribe scribe(100);
  REQUIRE(scribe.post(60, [&] { go_on.get_future().wait(); }));
  CHECK(scribe.is_busy());
  CHECK(scribe.post(40, [] {}));
  CHECK_FALSE(scribe.post(1, [] {}));
  CHECK(scribe.post(0, [] {}));  // what holds nothing always has its place
  go_on.set_value();
  scribe.finish();
  CHECK(scribe.post(100, [] {}));
}

TEST_CASE("a scribe whose disk takes nothing for too long takes nothing more", "[sequences]") {
  std::promise<void> go_on;
  Scribe scribe(100, 0.05);
  REQUIRE(scribe.post(1, [&] { go_on.get_future().wait(); }));
  CHECK(scribe.post(1, [] {}));
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  CHECK_FALSE(scribe.post(1, [] {}));
  go_on.set_value();
  scribe.finish();
  CHECK(scribe.post(1, [] {}));
}

TEST_CASE("a job that throws is told, and harms no other", "[sequences]") {
  Scribe scribe(100);
  bool is_done = false;
  REQUIRE(scribe.post(60, [] { throw 1; }));
  scribe.finish();
  CHECK(scribe.has_failed());
  REQUIRE(scribe.post(100, [&] { is_done = true; }));
  scribe.finish();
  CHECK(is_done);
}
