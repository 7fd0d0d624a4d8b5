#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <new>
#include <thread>

#include "sequences/supervisor.hpp"
#include "tests/support/live_rig.hpp"

using namespace rvbench;

namespace {

thread_local bool has_no_memory = false;

// Safety inputs that use up the last memory of whoever asks them.
class GreedyInputs final : public hal::SafetyInputs {
 public:
  Status connect() override { return Done{}; }
  Result<hal::SafetyStatus> read() override {
    has_no_memory = true;
    throw std::bad_alloc();
  }
};

void* memory_of(std::size_t bytes) {
  void* const memory = has_no_memory ? nullptr : std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return memory_of(bytes); }
void* operator new[](std::size_t bytes) { return memory_of(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

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
