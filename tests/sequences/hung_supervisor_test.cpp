#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "sequences/supervisor.hpp"
#include "tests/hal/service_manager.hpp"
#include "tests/sequences/run_fixture.hpp"
#include "tests/support/live_rig.hpp"
#include "tests/support/passing_devices.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace rvbench;

namespace {

const std::string warm_up_plan = R"({
  "name": "short",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 1.5, "rated_output_torque_Nm": 1},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.5},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 60, "speed_rpm": 605, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
            "settling": {"hold_s": 0.5, "timeout_s": 10}, "record": {"output_turns": 40}}],
  "teardown": {"standstill_timeout_s": 5}
})";

// Safety inputs that answer as long as they may.
class HangingInputs final : public hal::SafetyInputs {
 public:
  explicit HangingInputs(const std::atomic<bool>& answers) : answers_(answers) {}
  Status connect() override { return Done{}; }
  Result<hal::SafetyStatus> read() override {
    answers_.wait(false);
    return hal::SafetyStatus{false, false, 25};
  }

 private:
  const std::atomic<bool>& answers_;
};

// Counts calls to devices that only the supervisor may use.
class CountingBrake final : public test::PassingBrake {
 public:
  CountingBrake(std::unique_ptr<hal::Brake> brake, std::atomic<int>& releases)
      : PassingBrake(std::move(brake)), releases_(releases) {}
  Status release() noexcept override {
    ++releases_;
    return behind_->release();
  }

 private:
  std::atomic<int>& releases_;
};

struct HangingBench {
  HangingBench() {
    rig.safety = std::make_unique<HangingInputs>(answers);
    rig.brake = std::make_unique<CountingBrake>(std::move(rig.brake), releases);
  }

  hal::Rig rig = test::make_live_rig();
  std::atomic<bool> answers = true;
  std::atomic<int> releases = 0;
  test::MemoryRecording recording;
};

// A drive whose stop hangs, and with it every later call: they wait for one lock.
class HangingDrive final : public test::PassingDrive {
 public:
  using PassingDrive::PassingDrive;
  Status set_speed(double speed_rpm) override {
    {
      const std::lock_guard lock(mutex_);
      if (const Status status = behind_->set_speed(speed_rpm); !status) return status;
    }
    if (in_command) in_command();
    return Done{};
  }
  Result<hal::DriveStatus> read() override {
    const std::lock_guard lock(mutex_);
    return behind_->read();
  }
  void stop() noexcept override {
    const std::lock_guard lock(mutex_);
    has_hung = true;
    never_.wait(false);
  }

  std::atomic<bool> has_hung = false;
  std::function<void()> in_command;  ///< what befalls while a speed is commanded

 private:
  std::mutex mutex_;
  std::atomic<bool> never_ = false;
};

// A bus that never tells its counters.
class DeadBus final : public hal::BusMonitor {
 public:
  Result<hal::BusCounters> read() override {
    never_.wait(false);
    return hal::BusCounters{};
  }

 private:
  std::atomic<bool> never_ = false;
};

}  // namespace

TEST_CASE("a supervisor that hangs in a device's call holds up neither stop nor end",
          "[sequences][safety]") {
  const test::ScratchFolder scratch;
  const test::ServiceManager manager((scratch / "notify").string());
  // Its thread never comes back: what it uses stays until the program ends.
  HangingBench& hanging = *new HangingBench;
  test::LiveBench& bench = test::live_bench(hanging.rig);
  double hung_s = 0;
  std::jthread trouble([&](const std::stop_token& stop) {
    while (bench.setpoint_rpm < 605 && !stop.stop_requested()) std::this_thread::yield();
    hung_s = bench.clock.now_s();
    hanging.answers = false;
  });
  test::EventTexts observer;
  std::stop_source nobody;
  const auto summary = sequences::run_sequence(test::plan_of(warm_up_plan), hanging.rig,
                                               hanging.recording, observer, nobody.get_token());
  const double ended_s = bench.clock.now_s();
  trouble.join();
  CHECK(summary.supervisor_hung);
  CHECK(summary.ending.error_kind == ErrorKind::device_lost);
  CHECK_THAT(summary.ending.reason, Catch::Contains("the supervisor has not come round for 0.5"));
  CHECK_THAT(summary.ending.reason, Catch::Contains("supervisor hung"));
  CHECK_THAT(observer.texts.back(), Catch::Contains("supervisor hung"));
  CHECK(std::ranges::none_of(observer.texts, [](const std::string& text) {
    return text.starts_with("supervisor: ");  // its figures are still its own
  }));
  CHECK(bench.stops > 0);
  CHECK(bench.setpoint_rpm == 0);
  CHECK(summary.shaft_stopped);  // by the drive's word
  CHECK_FALSE(summary.brake_released);
  CHECK(hanging.releases == 0);  // its own watchdog lets it go: nobody may wait for its lock
  CHECK(ended_s - hung_s > sequences::Supervisor::longest_end_s);
  CHECK(ended_s - hung_s < sequences::Supervisor::longest_end_s + 5);
  // Of one that hangs systemd hears no more: what it heard before fits into its queue.
  while (!manager.heard().empty()) continue;
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  CHECK(manager.heard().empty());
}

TEST_CASE("a stop that hangs holds up the supervisor, and not the end", "[sequences][safety]") {
  HangingBench& hanging = *new HangingBench;  // as above
  auto hanging_drive = std::make_unique<HangingDrive>(std::move(hanging.rig.drive));
  const HangingDrive& drive = *hanging_drive;
  hanging.rig.drive = std::move(hanging_drive);
  test::LiveBench& bench = test::live_bench(hanging.rig);
  std::jthread trouble([&](const std::stop_token& stop) {
    while (bench.setpoint_rpm < 605 && !stop.stop_requested()) std::this_thread::yield();
    bench.torque_Nm = 9;  // above its interlock
  });
  test::EventTexts observer;
  std::stop_source nobody;
  const auto summary = sequences::run_sequence(test::plan_of(warm_up_plan), hanging.rig,
                                               hanging.recording, observer, nobody.get_token());
  trouble.join();
  CHECK(drive.has_hung);
  CHECK(summary.supervisor_hung);
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_FALSE(summary.shaft_stopped);  // here nothing but the drive's own watchdog could do it
  CHECK_THAT(observer.texts.back(), Catch::Contains("supervisor hung"));
}

TEST_CASE("a stop that hangs while a speed is commanded holds up no sequencer",
          "[sequences][safety]") {
  HangingBench& hanging = *new HangingBench;  // as above
  auto hanging_drive = std::make_unique<HangingDrive>(std::move(hanging.rig.drive));
  HangingDrive& drive = *hanging_drive;
  hanging.rig.drive = std::move(hanging_drive);
  test::LiveBench& bench = test::live_bench(hanging.rig);
  drive.in_command = [&] {
    if (bench.setpoint_rpm < 605) return;
    bench.torque_Nm = 9;  // above its interlock
    while (!drive.has_hung) std::this_thread::yield();
  };
  test::EventTexts observer;
  std::stop_source nobody;
  const auto summary = sequences::run_sequence(test::plan_of(warm_up_plan), hanging.rig,
                                               hanging.recording, observer, nobody.get_token());
  CHECK(summary.supervisor_hung);
  CHECK(summary.ending.outcome == Outcome::error);
}

TEST_CASE("a bus that never tells its counters makes the run an error that must exit",
          "[sequences][can][safety]") {
  HangingBench& hanging = *new HangingBench;  // as above
  hanging.rig.buses.push_back(std::make_unique<DeadBus>());
  auto plan_text = warm_up_plan;
  plan_text.replace(plan_text.find("\"duration_s\": 60"), 16, "\"duration_s\": 0.1");
  test::EventTexts observer;
  std::stop_source nobody;
  const auto summary = sequences::run_sequence(test::plan_of(plan_text), hanging.rig,
                                               hanging.recording, observer, nobody.get_token());
  CHECK(summary.bus_hung);
  CHECK_FALSE(summary.supervisor_hung);
  CHECK(summary.brake_released);
  REQUIRE(summary.points.size() == 1);
  CHECK(summary.points[0].status == "bus_errors");
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_THAT(summary.ending.reason, Catch::Contains("the program must exit"));
  CHECK_THAT(observer.texts.back(), Catch::StartsWith("ERROR"));
}
