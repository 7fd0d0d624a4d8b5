#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>

#include "sequences/supervisor.hpp"
#include "tests/sequences/run_fixture.hpp"
#include "tests/support/live_rig.hpp"
#include "tests/support/passing_devices.hpp"

using namespace rvbench;

namespace {

constexpr long plenty = 1'000'000'000;
thread_local long allocations_left = plenty;

// While it lives, its thread gets no memory beyond so many requests.
class Shortage {
 public:
  explicit Shortage(long allocations) { allocations_left = allocations; }
  ~Shortage() { allocations_left = plenty; }
  Shortage(const Shortage&) = delete;
  Shortage& operator=(const Shortage&) = delete;
};

// Safety inputs that use up the last memory of whoever asks them.
class GreedyInputs final : public hal::SafetyInputs {
 public:
  Status connect() override { return Done{}; }
  Result<hal::SafetyStatus> read() override {
    allocations_left = 0;
    throw std::bad_alloc();
  }
};

// A drive that does the same to the sequencer, once the shaft turns.
class GreedyDrive final : public test::PassingDrive {
 public:
  GreedyDrive(std::unique_ptr<hal::Drive> drive, test::LiveBench& bench)
      : PassingDrive(std::move(drive)), bench_(bench) {}
  Result<hal::DriveStatus> read() override {
    if (bench_.setpoint_rpm != 0 && bench_.stops == 0) allocations_left = 0;
    return behind_->read();
  }

 private:
  test::LiveBench& bench_;
};

void* memory_of(std::size_t bytes) {
  void* const memory = allocations_left <= 0 ? nullptr : std::malloc(bytes);
  --allocations_left;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return memory_of(bytes); }
void* operator new[](std::size_t bytes) { return memory_of(bytes); }
// Catch2 makes its cases like this.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return std::malloc(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return std::malloc(bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

TEST_CASE("without memory the drive is stopped all the same, and the run ends",
          "[sequences][safety]") {
  hal::Rig rig = test::make_live_rig();
  REQUIRE(rig.accelerometers->start());
  rig.safety = std::make_unique<GreedyInputs>();
  sequences::Supervisor supervisor(rig, {.input_speed_rpm = 2200,
                                         .input_torque_Nm = 8,
                                         .acceleration_m_s2 = 300,
                                         .housing_temp_degC = 60,
                                         .stale_after_s = 5});
  sequences::DriveReport report;
  report.status.seen_s = report.command.seen_s = rig.clock->now_s();
  supervisor.start(report);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!supervisor.latched() && std::chrono::steady_clock::now() < until) {
    std::this_thread::yield();
  }
  REQUIRE(supervisor.latched());
  CHECK(test::live_bench(rig).stops == 1);
  CHECK(supervisor.latched()->outcome == Outcome::error);
  CHECK(supervisor.latched()->reason == "no memory left");
  CHECK(supervisor.end());
}

TEST_CASE("a sequencer without memory stops the shaft, and run_sequence does not throw",
          "[sequences][safety]") {
  const auto plan = test::plan_of(R"({
    "name": "short",
    "specimen": {"kinematics": "rv20e", "gear_ratio": 1.5, "rated_output_torque_Nm": 1},
    "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                   "housing_temp_degC": 60, "stale_after_s": 2},
    "setup": [{"phase": "connect"},
              {"phase": "warm_up", "duration_s": 60, "speed_rpm": 605, "load_pct": 50}],
    "main": [{"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
              "record": {"output_turns": 40}}],
    "teardown": {"standstill_timeout_s": 5}
  })");
  hal::Rig rig = test::make_live_rig();
  test::LiveBench& bench = test::live_bench(rig);
  rig.drive = std::make_unique<GreedyDrive>(std::move(rig.drive), bench);
  test::MemoryRecording recording;
  test::MemoryObserver observer;
  std::stop_source nobody;
  sequences::RunSummary summary;
  {
    const Shortage shortage(plenty);  // that of the drive ends here
    summary = sequences::run_sequence(plan, rig, recording, observer, nobody.get_token());
  }
  CHECK(bench.stops > 0);
  CHECK(bench.setpoint_rpm == 0);
  CHECK(bench.brake_Nm == 0);
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_FALSE(summary.supervisor_hung);
  CHECK_THAT(summary.ending.reason,
             Catch::Contains("no memory left") || Catch::Contains("bad_alloc"));
}

TEST_CASE("a supervisor that gets no thread has none that hangs", "[sequences][safety]") {
  hal::Rig rig = test::make_live_rig();
  REQUIRE(rig.accelerometers->start());
  sequences::DriveReport report;
  int refused = 0;
  for (bool is_started = false; !is_started && refused < 1000;) {
    sequences::Supervisor supervisor(rig, {.stale_after_s = 5});
    try {
      const Shortage shortage(refused);
      supervisor.start(report);
      is_started = true;
    } catch (const std::bad_alloc&) {
      ++refused;
    }
    if (!supervisor.end()) FAIL("the supervisor hangs after " << refused << " allocations");
  }
  CHECK(refused > 0);
  CHECK(refused < 1000);
}
