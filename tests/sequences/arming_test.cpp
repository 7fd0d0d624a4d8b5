#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <memory>

#include "sequences/bench_loop.hpp"
#include "tests/sequences/run_fixture.hpp"
#include "tests/support/live_rig.hpp"
#include "tests/support/passing_devices.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;

namespace {

// Answers its first question with an error, so that the bench waits for the second answer before it
// arms. While it gives that one the emergency stop is pressed and the supervisor begins to stop it,
// which takes longer than arming.
class DriveStoppedWhileArming final : public test::PassingDrive {
 public:
  DriveStoppedWhileArming(std::unique_ptr<hal::Drive> drive, test::LiveBench& bench)
      : PassingDrive(std::move(drive)), bench_(bench) {
    bench_.stop_is_slow = true;
  }
  Result<hal::DriveStatus> read() override {
    if (questions_++ == 0) return IoError{IoErrc::timeout, "drive"};
    if (questions_ == 2) {
      bench_.estop = true;
      const bool comes = test::wait_until([this] { return is_being_stopped_.load(); });
      if (!comes) return IoError{IoErrc::timeout, "nobody stops it"};
    }
    return behind_->read();
  }
  void stop() noexcept override {
    is_being_stopped_ = true;
    behind_->stop();
  }

 private:
  test::LiveBench& bench_;
  int questions_ = 0;
  std::atomic<bool> is_being_stopped_ = false;
};

}  // namespace

TEST_CASE("a trip that falls while arming ends the run before anything is armed",
          "[sequences][safety]") {
  hal::Rig rig = test::make_live_rig();
  test::LiveBench& bench = test::live_bench(rig);
  rig.drive = std::make_unique<DriveStoppedWhileArming>(std::move(rig.drive), bench);
  test::MemoryRecording recording;
  test::EventTexts observer;
  std::stop_source nobody;
  const auto summary = sequences::run_sequence(test::plan_of(test::live_plan), rig, recording,
                                               observer, nobody.get_token());
  CHECK(summary.ending.error_kind == ErrorKind::safety_trip);
  CHECK(summary.ending.reason == "the emergency stop is pressed");
  CHECK(std::ranges::count(observer.texts, sequences::armed_event) == 0);
  CHECK(std::ranges::count(observer.texts, "phase warm_up") == 0);
}
