#include "sequences/bus_watch.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <memory>
#include <thread>

#include "tests/sequences/run_fixture.hpp"
#include "tests/support/live_rig.hpp"

using namespace rvbench;
using test::Run;

namespace {

// An interface whose counters move when the rig's time comes.
class CountingBus final : public hal::BusMonitor {
 public:
  struct Script {
    std::string counter = "bus_error";
    double from_s = 0;     // of the rig's time: then it has counted 3 more
    bool is_gone = false;  // from then on it cannot be read
    int reads = 0;
  };

  CountingBus(std::string name, Script& script, const hal::Clock& clock)
      : name_(std::move(name)), script_(script), clock_(clock) {}

  Result<hal::BusCounters> read() override {
    ++script_.reads;
    const bool now = clock_.now_s() >= script_.from_s;
    if (now && script_.is_gone) return IoError{IoErrc::disconnected, "CAN " + name_ + ": count"};
    return hal::BusCounters{name_, {{"rx_dropped", 2}, {script_.counter, now ? 10u : 7u}}};
  }

 private:
  std::string name_;
  Script& script_;
  const hal::Clock& clock_;
};

// One that takes its time.
class SlowBus final : public hal::BusMonitor {
 public:
  explicit SlowBus(const std::atomic<bool>& answers) : answers_(answers) {}
  Result<hal::BusCounters> read() override {
    answers_.wait(false);
    return hal::BusCounters{"can0", {{"bus_error", 1}}};
  }

 private:
  const std::atomic<bool>& answers_;
};

std::string at_end(sequences::BusWatch& watch) {
  watch.end();
  return watch.verdict();
}

// The record of small_plan is made within this time.
constexpr double in_record_s = 15;
constexpr double never_s = 1e9;

struct BusRun : Run {
  CountingBus::Script can0{.from_s = never_s}, can1{.from_s = never_s};

  BusRun() {
    rig.buses.push_back(std::make_unique<CountingBus>("can0", can0, *rig.clock));
    rig.buses.push_back(std::make_unique<CountingBus>("can1", can1, *rig.clock));
  }
  std::string status() { return go().points.at(0).status; }
  bool tells(const std::string& words) const {
    return std::ranges::any_of(recording.notes, [&](const auto& note) {
      return note.second.find(words) != std::string::npos;
    });
  }
};

}  // namespace

SCENARIO("a record in which a bus had errors is no good record", "[sequences][can]") {
  BusRun run;
  WHEN("no counter moves") {
    CHECK(run.status() == "ok");
    THEN("each was read before and after") {
      CHECK(run.can0.reads == 2);
      CHECK(run.can1.reads == 2);
      CHECK_FALSE(run.tells("can"));
    }
  }
  WHEN("a counter of one bus moves during the record") {
    run.can1.from_s = in_record_s;
    CHECK(run.status() == "bus_errors");
    THEN("interface and counter are named, and the others are not") {
      CHECK(run.tells("point 0: can1: bus_error +3"));
      CHECK_FALSE(run.tells("rx_dropped"));
      CHECK_FALSE(run.tells("can0"));
    }
    THEN("the run is INVALID") { CHECK(run.summary.ending.outcome == Outcome::invalid); }
  }
  WHEN("it moved before the record began") {
    run.can1.from_s = 1;
    CHECK(run.status() == "ok");
  }
  WHEN("the counters cannot be read any more") {
    run.can0.from_s = in_record_s;
    run.can0.is_gone = true;
    CHECK(run.status() == "bus_errors");
    CHECK(run.tells("point 0: CAN can0: count: disconnected"));
  }
  WHEN("they cannot be read at the beginning") {
    run.can0.from_s = 0;
    run.can0.is_gone = true;
    CHECK(run.status() == "bus_errors");
  }
}

TEST_CASE("what has moved is told of each bus", "[sequences][can]") {
  BusRun run;
  sequences::BusWatch watch(run.rig);
  watch.begin();
  CHECK(at_end(watch).empty());
  run.can0 = {.counter = "bus_off", .from_s = 0};
  run.can1 = {.counter = "bus_error", .from_s = 0};
  CHECK(at_end(watch) == "can0: bus_off +10, bus_error is gone; can1: bus_error +3");
  watch.begin();
  CHECK(at_end(watch).empty());
  run.can1.from_s = never_s;  // as an interface that was taken down and made anew
  CHECK(at_end(watch) == "can1: bus_error began anew");
  watch.begin();
  run.can1.counter = "rx_dropped";  // as an interface of that name that has no controller
  CHECK(at_end(watch) == "can1: bus_error is gone");
}

TEST_CASE("in real time nobody waits for a bus", "[sequences][can][safety]") {
  std::atomic<bool> answers = false;
  hal::Rig rig = test::make_live_rig();
  rig.buses.push_back(std::make_unique<SlowBus>(answers));
  sequences::BusWatch watch(rig);
  watch.begin();
  CHECK_FALSE(watch.is_ready());
  CHECK_THAT(watch.verdict(), Catch::Contains("not told in time"));
  watch.end();
  CHECK_FALSE(watch.is_ready());
  answers = true;
  answers.notify_all();
  while (!watch.is_ready()) std::this_thread::yield();
  CHECK(watch.verdict().empty());
}

TEST_CASE("a look that comes too late is taken for no other", "[sequences][can][safety]") {
  std::atomic<bool> answers = false;
  hal::Rig rig = test::make_live_rig();
  rig.buses.push_back(std::make_unique<SlowBus>(answers));
  sequences::BusWatch watch(rig);
  const auto let_it_answer = [&] {
    answers = true;
    answers.notify_all();
    while (!watch.is_ready()) std::this_thread::yield();
  };
  watch.begin();
  SECTION("the first one of a record that has begun without it") {
    watch.open_record();
    let_it_answer();
    watch.end();
    while (!watch.is_ready()) std::this_thread::yield();
    CHECK_THAT(watch.verdict(), Catch::Contains("not told in time"));
    watch.begin();
    while (!watch.is_ready()) std::this_thread::yield();
    watch.open_record();
    watch.end();
    while (!watch.is_ready()) std::this_thread::yield();
    CHECK(watch.verdict().empty());
  }
  SECTION("the last one of the record before") {
    watch.end();
    watch.begin();
    let_it_answer();
    CHECK_THAT(watch.verdict(), Catch::Contains("not told in time"));
  }
}

TEST_CASE("a bus that hangs is told at the end", "[sequences][can][safety]") {
  std::atomic<bool> answers = false;
  hal::Rig rig = test::make_live_rig();
  rig.buses.push_back(std::make_unique<SlowBus>(answers));
  sequences::BusWatch watch(rig);
  CHECK(watch.finish());
  sequences::BusWatch hindered(rig);
  hindered.begin();
  CHECK_FALSE(hindered.finish());
  CHECK_FALSE(hindered.finish());
  answers = true;
  answers.notify_all();
  while (!hindered.is_ready()) std::this_thread::yield();  // it used the rig until now
}
