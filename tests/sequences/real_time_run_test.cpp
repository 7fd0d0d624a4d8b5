#include <atomic>
#include <catch2/catch.hpp>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "tests/sequences/run_fixture.hpp"
#include "tests/support/live_rig.hpp"

using namespace rvbench;

namespace {

// A disk, or a terminal, that hangs until somebody lets it go on.
class Gate {
 public:
  void wait() {
    std::unique_lock lock(mutex_);
    opened_.wait(lock, [this] { return is_open_; });
  }
  void open() {
    {
      const std::lock_guard lock(mutex_);
      is_open_ = true;
    }
    opened_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool is_open_ = false;
};

class HangingRecording final : public hal::RecordingWriter {
 public:
  explicit HangingRecording(Gate& gate) : gate_(gate) {}
  Status append(int, const hal::AccelerationBlock& block) override {
    gate_.wait();
    scans += double(block.scans.rows());
    return Done{};
  }
  Status append(int, const hal::TorqueBlock&) override { return Done{}; }
  Status end_point(const hal::PointResult&) override {
    if (fail_end_point) return IoError{IoErrc::refused, "No space left on device"};
    ++ended;
    return Done{};
  }
  Status note(double, const std::string&) override { return Done{}; }
  Status close() override { return Done{}; }

  double scans = 0;
  int ended = 0;
  bool fail_end_point = false;

 private:
  Gate& gate_;
};

// Lets the gate open once the shaft has been told to stop.
class GateAtStop {
 public:
  GateAtStop(Gate& gate, test::LiveBench& bench)
      : thread_([&gate, &bench](const std::stop_token& stop) {
          while (bench.stops == 0 && !stop.stop_requested()) std::this_thread::yield();
          gate.open();
        }) {}

 private:
  std::jthread thread_;
};

class Listener final : public sequences::RunObserver {
 public:
  explicit Listener(Gate& gate) : gate_(gate) {}
  void progress(double, double, const std::string&) override { gate_.wait(); }
  void event(double, const std::string& text) override {
    gate_.wait();
    texts.push_back(text);
  }
  std::vector<std::string> texts;

 private:
  Gate& gate_;
};

// Its log hangs, its screen does not.
class HangingLog final : public sequences::RunObserver {
 public:
  explicit HangingLog(Gate& gate) : gate_(gate) {}
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string&) override {
    gate_.wait();
    has_told = true;
  }
  std::atomic<bool> has_told = false;

 private:
  Gate& gate_;
};

// A bus that takes longer to answer than any value may be old.
class SlowBus final : public hal::BusMonitor {
 public:
  explicit SlowBus(hal::Clock& clock) : clock_(clock) {}
  Result<hal::BusCounters> read() override {
    clock_.wait_until(clock_.now_s() + 1.2);
    return hal::BusCounters{"can0", {}};
  }

 private:
  hal::Clock& clock_;
};

struct LiveRun {
  LiveRun() { gate.open(); }

  const sequences::RunSummary& go() {
    summary = sequences::run_sequence(test::plan_of(test::live_plan), rig, recording, listener,
                                      stop.get_token());
    return summary;
  }

  hal::Rig rig = test::make_live_rig();
  test::LiveBench& bench = test::live_bench(rig);
  Gate gate;
  HangingRecording recording{gate};
  Listener listener{gate};
  std::stop_source stop;
  sequences::RunSummary summary;
};

// A run whose disk and screen hang until the shaft has been stopped.
struct HinderedRun {
  hal::Rig rig = test::make_live_rig();
  test::LiveBench& bench = test::live_bench(rig);
  Gate gate;
  HangingRecording recording{gate};
  Listener listener{gate};
  std::stop_source stop;

  sequences::RunSummary go() {
    const GateAtStop opener(gate, bench);
    return sequences::run_sequence(test::plan_of(test::live_plan), rig, recording, listener,
                                   stop.get_token());
  }
};

}  // namespace

TEST_CASE("a run in real time measures, stops the shaft and releases the brake", "[sequences]") {
  LiveRun run;
  const auto& summary = run.go();
  CHECK(summary.ending.reason == "everything was measured");
  CHECK(summary.ending.outcome == Outcome::pass);
  CHECK(summary.shaft_stopped);
  CHECK(summary.brake_released);
  CHECK(run.bench.brake_Nm == 0);
  CHECK(run.bench.setpoint_rpm == 0);
  REQUIRE(summary.points.size() == 1);
  CHECK(summary.points[0].speed_rpm == Approx(1815).epsilon(0.001));
  CHECK(run.recording.ended == 1);
  // 40 turns of the output shaft are 60 of the input shaft: 1.98 s.
  CHECK(run.recording.scans >= 4960 * 1.98);
  CHECK_THAT(run.listener.texts.back(), Catch::StartsWith("measured: "));
}

TEST_CASE("a disk and a screen that hang hold up neither the run nor its end",
          "[sequences][safety]") {
  HinderedRun run;
  const auto summary = run.go();
  CHECK(summary.ending.outcome == Outcome::pass);
  CHECK(run.recording.ended == 1);
  CHECK(run.recording.scans >= 4960 * 1.98);
  const auto& texts = run.listener.texts;
  CHECK_THAT(texts.back(), Catch::Contains("s behind: a power cut would have cost"));
  CHECK_THAT(texts.at(texts.size() - 2), Catch::StartsWith("measured: "));
}

TEST_CASE("an E-stop ends a run whose disk and screen hang", "[sequences][safety]") {
  HinderedRun run;
  run.bench.estop = true;
  const auto summary = run.go();
  CHECK(summary.ending.error_kind == ErrorKind::safety_trip);
  CHECK(run.bench.setpoint_rpm == 0);
}

TEST_CASE("no command overtakes a stop that is under way", "[sequences][safety]") {
  LiveRun run;
  run.bench.stop_is_slow = true;
  double driven_s = 0;  // after the stop had been given
  std::jthread watch([&](const std::stop_token& stop) {
    while (run.bench.setpoint_rpm < 1815 && !stop.stop_requested()) std::this_thread::yield();
    run.bench.estop = true;
    while (run.bench.setpoint_rpm != 0 && !stop.stop_requested()) std::this_thread::yield();
    while (!stop.stop_requested()) {
      if (run.bench.setpoint_rpm != 0) driven_s = run.bench.clock.now_s();
      std::this_thread::yield();
    }
  });
  const auto& summary = run.go();
  watch.request_stop();
  watch.join();
  CHECK(summary.ending.error_kind == ErrorKind::safety_trip);
  CHECK_THAT(summary.ending.reason, Catch::Contains("emergency stop"));
  CHECK(driven_s == 0);
}

TEST_CASE("a drive whose answers hang is lost, and holds up nobody", "[sequences][safety]") {
  LiveRun run;
  std::jthread trouble([&](const std::stop_token& stop) {
    while (run.bench.setpoint_rpm < 1815 && !stop.stop_requested()) std::this_thread::yield();
    run.bench.drive_hangs = true;
  });
  const auto& summary = run.go();
  CHECK(summary.ending.error_kind == ErrorKind::device_lost);
  CHECK_THAT(summary.ending.reason, Catch::StartsWith("drive silent for "));
  CHECK(run.bench.stops > 0);
  CHECK(run.bench.brake_Nm == 0);
}

TEST_CASE("what could not be written is no PASS, however late that is told", "[sequences]") {
  LiveRun run;
  run.recording.fail_end_point = true;
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_THAT(summary.ending.reason, Catch::Contains("No space left on device"));
  CHECK(run.bench.setpoint_rpm == 0);
}

TEST_CASE("a bus that is slow to tell its counters makes nobody's values old", "[sequences]") {
  LiveRun run;
  run.rig.buses.push_back(std::make_unique<SlowBus>(*run.rig.clock));
  const auto& summary = run.go();
  CHECK(summary.ending.reason == "everything was measured");
  CHECK(summary.ending.outcome == Outcome::pass);
}

TEST_CASE("a run whose log lacks events is an error", "[sequences]") {
  LiveRun run;
  Gate gate;
  HangingLog log(gate);
  const auto summary = sequences::run_sequence(test::plan_of(test::live_plan), run.rig,
                                               run.recording, log, run.stop.get_token());
  CHECK(summary.observer_hung);
  CHECK(summary.events_untold > 0);
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_THAT(summary.ending.reason, Catch::StartsWith("the log lacks "));
  CHECK(summary.points.at(0).status == "ok");
  gate.open();
  while (!log.has_told) std::this_thread::yield();
}
