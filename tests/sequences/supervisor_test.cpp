#include "sequences/supervisor.hpp"

#include <catch2/catch.hpp>
#include <iterator>
#include <memory>
#include <thread>

#include "tests/hal/service_manager.hpp"
#include "tests/support/live_rig.hpp"
#include "tests/support/plan_of.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/wait_until.hpp"

using namespace rvbench;
using sequences::DriveReport;
using sequences::Supervisor;
using test::wait_until;

namespace {

constexpr double impatient_s = 0.3;
constexpr double patient_s = 5;  // a busy computer is no lost device

sequences::Interlocks limits(double stale_after_s) {
  return {.input_speed_rpm = 2200,
          .input_torque_Nm = 8,
          .acceleration_m_s2 = 300,
          .housing_temp_degC = 60,
          .stale_after_s = stale_after_s};
}

// A supervisor whose sequencer has told of the drive once, and not come back since.
struct Watched {
  explicit Watched(double stale_after_s = patient_s) : supervisor(rig, limits(stale_after_s)) {
    REQUIRE(rig.torque_sensor->connect());
    REQUIRE(rig.accelerometers->start());
    started_s = rig.clock->now_s();
    report.status.seen_s = report.command.seen_s = rig.clock->now_s();
    supervisor.start(report);
  }
  void drive_is_well() {
    report.status.seen_s = report.command.seen_s = rig.clock->now_s();
    (void)supervisor.exchange(report);
  }

  hal::Rig rig = test::make_live_rig();
  test::LiveBench& bench = test::live_bench(rig);
  Supervisor supervisor;
  DriveReport report;
  double started_s = 0;  ///< the streams have
};

// A stream as it is handed over: each block begins where all samples before it have led to.
struct Continuity {
  void add(double t0_s, long fresh, long lost, double rate_Hz) {
    REQUIRE(lost == 0);
    if (samples == 0) first_s = t0_s;
    REQUIRE(t0_s == Approx(first_s + double(samples) / rate_Hz).margin(0.01 / rate_Hz));
    samples += fresh;
  }

  long samples = 0;
  double first_s = -1;
};

// A clock on which a minute passes in a second.
class HastyClock final : public hal::Clock {
 public:
  explicit HastyClock(std::unique_ptr<hal::Clock> real) : real_(std::move(real)) {}
  double now_s() const override { return haste * real_->now_s(); }
  void wait_until(double time_s) override { real_->wait_until(time_s / haste); }
  bool is_virtual() const override { return false; }

 private:
  static constexpr double haste = 60;
  std::unique_ptr<hal::Clock> real_;
};

}  // namespace

TEST_CASE("an interlock stops the drive though the sequencer hangs", "[sequences][safety]") {
  Watched watched;
  watched.report.status.seen_s = sequences::DeviceWatch::always_seen_s;
  watched.report.command.seen_s = sequences::DeviceWatch::always_seen_s;
  (void)watched.supervisor.exchange(watched.report);
  SECTION("an E-stop") { watched.bench.estop = true; }
  SECTION("torque above its limit") { watched.bench.torque_Nm = 9; }
  CHECK(wait_until([&] { return watched.bench.stops > 0; }));
  CHECK(wait_until([&] { return watched.supervisor.latched().has_value(); }));
  CHECK(watched.supervisor.latched()->error_kind == ErrorKind::safety_trip);
  CHECK(watched.supervisor.state() == sequences::SupervisorState::faulted);
}

TEST_CASE("a trip is latched: a good value does not take it back, and the drive is stopped once",
          "[sequences][safety]") {
  Watched watched;
  watched.drive_is_well();
  watched.bench.estop = true;
  REQUIRE(wait_until([&] { return watched.supervisor.latched().has_value(); }));
  watched.bench.estop = false;
  const double later_s = watched.rig.clock->now_s() + 0.05;
  while (watched.rig.clock->now_s() < later_s) watched.drive_is_well();
  CHECK(watched.supervisor.latched()->error_kind == ErrorKind::safety_trip);
  CHECK(watched.bench.stops == 1);
}

TEST_CASE("a reset does not lead out of a trip, neither while the drive is being stopped nor after",
          "[sequences][safety]") {
  Watched watched;
  watched.drive_is_well();
  watched.bench.stop_is_slow = true;
  watched.bench.estop = true;
  REQUIRE(wait_until([&] { return watched.supervisor.is_tripped(); }));
  bool was_reset = false;
  while (watched.supervisor.is_stopping_drive()) {
    was_reset = watched.supervisor.handle(sequences::SupervisorEvent::reset) || was_reset;
  }
  CHECK_FALSE(was_reset);
  CHECK_FALSE(watched.supervisor.handle(sequences::SupervisorEvent::reset));
  CHECK(watched.supervisor.state() == sequences::SupervisorState::faulted);
}

TEST_CASE("a sequencer that hangs ends the run: nobody tells of the drive any more",
          "[sequences][safety]") {
  Watched watched(impatient_s);
  CHECK(wait_until([&] { return watched.bench.stops > 0; }));
  REQUIRE(wait_until([&] { return watched.supervisor.latched().has_value(); }));
  CHECK(watched.supervisor.latched()->error_kind == ErrorKind::device_lost);
  CHECK_THAT(watched.supervisor.latched()->reason, Catch::Contains("drive silent for "));
  CHECK(watched.bench.stopped_s >= impatient_s - Supervisor::period_s);
}

TEST_CASE("while all is well the drive is left alone and no sample is lost", "[sequences]") {
  Watched watched;
  Continuity torque, accelerations;
  const double until_s = watched.rig.clock->now_s() + 0.5;
  while (watched.rig.clock->now_s() < until_s) {
    watched.report.status.seen_s = watched.report.command.seen_s = watched.rig.clock->now_s();
    const auto fresh = watched.supervisor.exchange(watched.report).fresh;
    if (const auto& block = fresh.torque) {
      torque.add(block->t0_s, std::ssize(block->samples), block->lost, fresh.torque_rate_Hz);
    }
    if (const auto& block = fresh.accelerations) {
      accelerations.add(block->t0_s, block->scans.rows(), block->lost, fresh.acceleration_rate_Hz);
    }
  }
  CHECK(watched.bench.stops == 0);
  CHECK_FALSE(watched.supervisor.latched());
  CHECK(torque.samples > 100);  // of 500: a busy computer may be late with the last ones
  CHECK(accelerations.samples > 500);
  CHECK(torque.first_s < watched.started_s + 1.001 / 1000);
  CHECK(accelerations.first_s < watched.started_s + 1.001 / 4960);
  watched.supervisor.end();
  CHECK(watched.supervisor.lateness().rounds() > 100);
}

TEST_CASE("a command to the brake is passed on once: nobody repeats an old one", "[sequences]") {
  Watched watched;
  watched.drive_is_well();
  watched.supervisor.hold_brake(70);
  REQUIRE(wait_until([&] { return watched.bench.brake_commands == 1; }));
  const double later_s = watched.rig.clock->now_s() + 0.02;
  while (watched.rig.clock->now_s() < later_s) watched.drive_is_well();
  CHECK(watched.bench.brake_commands == 1);
  CHECK(watched.bench.brake_Nm == 70);
}

TEST_CASE("while the shaft runs down the supervisor leaves the drive in silence",
          "[sequences][safety]") {
  Watched watched(impatient_s);
  watched.supervisor.handle(sequences::SupervisorEvent::stop);  // from FAULTED: nothing armed yet
  CHECK(watched.supervisor.state() == sequences::SupervisorState::faulted);
  watched.supervisor.handle(sequences::SupervisorEvent::reset);
  watched.supervisor.handle(sequences::SupervisorEvent::stop);
  REQUIRE(watched.supervisor.state() == sequences::SupervisorState::stopping);
  const double later_s = watched.rig.clock->now_s() + 2 * impatient_s;
  while (watched.rig.clock->now_s() < later_s) std::this_thread::yield();
  CHECK(watched.bench.stops == 0);
}

TEST_CASE("of a sequencer that hangs systemd hears no more, though the supervisor turns",
          "[sequences][safety]") {
  const test::ScratchFolder scratch;
  const test::ServiceManager manager((scratch / "notify").string());
  hal::Rig rig = test::make_live_rig();
  REQUIRE(rig.accelerometers->start());
  rig.clock = std::make_unique<HastyClock>(std::move(rig.clock));
  Supervisor supervisor(rig, limits(patient_s));
  supervisor.start({});
  const auto forget_what_came = [&] {
    while (!manager.heard().empty()) continue;
  };
  const auto has_begun_a_round_since = [&](double time_s) {
    const double now_s = rig.clock->now_s();
    return now_s - supervisor.silence_s() > time_s;
  };
  forget_what_came();
  REQUIRE(wait_until([&] {
    supervisor.hear_sequencer();
    return !manager.heard().empty();
  }));

  const double last_s = rig.clock->now_s();
  REQUIRE(
      wait_until([&] { return has_begun_a_round_since(last_s + Supervisor::longest_pause_s); }));
  const double late_s = rig.clock->now_s();
  REQUIRE(wait_until([&] { return has_begun_a_round_since(late_s); }));  // the one before is over
  forget_what_came();
  REQUIRE(
      wait_until([&] { return has_begun_a_round_since(late_s + Supervisor::longest_pause_s); }));
  CHECK(manager.heard().empty());
  CHECK(supervisor.end());
}
