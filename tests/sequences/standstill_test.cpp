#include "sequences/standstill.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "tests/sequences/run_fixture.hpp"
#include "tests/support/passing_devices.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;

namespace {

// What the log says of the teardown; empty if nothing.
std::string told_in_teardown(const Run& run) {
  for (const auto& [stopped, text] : run.observer.events) {
    if (text.find("in teardown: ") == 0) return text;
  }
  return "";
}

// An encoder that is torn off its shaft at that time: the angle stands still, the torque goes on.
class TornOff final : public test::PassingTorqueSensor {
 public:
  TornOff(std::unique_ptr<hal::TorqueSensor> sensor, double torn_s)
      : PassingTorqueSensor(std::move(sensor)), torn_s_(torn_s) {}

 protected:
  void show(hal::TorqueBlock& block) override {
    if (block.t0_s < torn_s_) return;
    for (hal::TorqueSample& sample : block.samples) {
      if (std::isnan(torn_rad_)) torn_rad_ = sample.angle_rad;
      sample.angle_rad = torn_rad_;
    }
  }

 private:
  double torn_s_;
  double torn_rad_ = not_known;
};

}  // namespace

TEST_CASE("with a dead drive it is told that the shaft's angle showed the standstill",
          "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_dead, 12);
  CHECK(run.go().shaft_stopped);
  CHECK_THAT(told_in_teardown(run), Catch::Contains("drive silent for") &&
                                        Catch::Contains("standstill was measured by the shaft's "
                                                        "angle"));
}

TEST_CASE("with a dead torque sensor it is told that only the drive knows", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::torque_sensor_dead, 12);
  CHECK(run.go().shaft_stopped);
  CHECK_THAT(told_in_teardown(run),
             Catch::Contains("standstill is what the drive says") && Catch::Contains("lost"));
}

TEST_CASE("with neither it is told that nothing confirmed the standstill", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_dead, 12);
  run.world().schedule(MirrorFault::torque_sensor_dead, 12);
  CHECK_FALSE(run.go().shaft_stopped);
  CHECK_THAT(told_in_teardown(run),
             Catch::Contains("could not be confirmed") && Catch::Contains("by its own watchdog"));
}

TEST_CASE("a shaft that goes on turning is told with its speed", "[sequences][safety]") {
  Run run({.ramp_rpm_s = 40});  // 1815 rpm take 45 s, and it is heard again at 11 s
  auto text = test::small_plan;
  text.insert(text.rfind('}'), R"(, "teardown": {"standstill_timeout_s": 11.2})");
  CHECK_FALSE(run.go(text).shaft_stopped);
  CHECK_THAT(told_in_teardown(run), Catch::Contains("the shaft does not stop") &&
                                        Catch::Contains("the shaft's angle still shows"));
}

TEST_CASE("a run without a fault has nothing to tell of its teardown", "[sequences]") {
  Run run;
  CHECK(run.go().shaft_stopped);
  CHECK(told_in_teardown(run).empty());
}

TEST_CASE("an angle that stands still while the drive turns the shaft does not release the brake",
          "[sequences][safety]") {
  Run run({.ramp_rpm_s = 300});
  run.rig.torque_sensor = std::make_unique<TornOff>(std::move(run.rig.torque_sensor), 12);
  const auto& summary = run.go();
  CHECK_THAT(summary.ending.reason, Catch::Contains("the torque sensor's angle 0 rpm"));
  CHECK(summary.shaft_stopped);
  // From 1815 rpm the ramp takes 6.05 s; the drive obeys, and is asked until it stands still.
  CHECK(run.world().brake_released_s() - run.stopped_s() > 6.05);
  CHECK(run.world().brake_released_s() - run.stopped_s() < 6.05 + 0.3);
}

TEST_CASE("a drive that falls silent while it speeds up does not make the angle doubtful",
          "[sequences][safety]") {
  for (const double silent_s : {0.06, 0.12, 0.18}) {
    CAPTURE(silent_s);
    Run start;
    start.go();
    const double started_s = start.started_s();
    Run run;
    run.world().schedule(MirrorFault::drive_dead, started_s + silent_s);
    CHECK(run.go().shaft_stopped);
  }
}

TEST_CASE("a drive that had fallen silent is left alone once it was told to stop",
          "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_dead, 12, 12.5);
  run.go();
  const double stopped_s = run.stopped_s();
  REQUIRE(std::isfinite(stopped_s));
  CHECK(stopped_s > 12.5 + 2.0);  // heard again, but not asked: its watchdog was to act first
}
