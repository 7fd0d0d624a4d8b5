#include <catch2/catch.hpp>
#include <cmath>

#include "tests/sequences/run_fixture.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;
using test::small_plan;

TEST_CASE("an interlock stops the drive within 20 ms and before anything is written down",
          "[sequences][safety]") {
  struct Case {
    MirrorFault fault;
    std::string reason;
  };
  const auto [fault, reason] = GENERATE(values<Case>({
      {MirrorFault::estop, "emergency stop"},
      {MirrorFault::guard_open, "guard"},
      {MirrorFault::over_torque, "input torque 100 N·m"},
      {MirrorFault::over_speed, "input speed"},
      {MirrorFault::over_temperature, "housing temperature 100 degC"},
      {MirrorFault::shock, "acceleration 485.1 m/s²"},
  }));
  CAPTURE(reason);
  for (const double at_s : {1.503, 12.007}) {  // in the warm-up, in the record
    Run run;
    run.world().schedule(fault, at_s, at_s + 0.5);  // gone before the shaft has stopped
    const auto& summary = run.go();
    CHECK(summary.ending.error_kind == ErrorKind::safety_trip);
    CHECK(exit_code(summary.ending) == 40);
    CHECK_THAT(summary.ending.reason, Catch::Contains(reason));
    CHECK(run.stopped_s() >= at_s);
    CHECK(run.stopped_s() <= at_s + 0.02);
    for (const auto& [stopped, text] : run.observer.events) {
      if (text == summary.ending.reason) CHECK(stopped);  // stop first, log after
    }
    CHECK(summary.shaft_stopped);
    CHECK(summary.brake_released);
    CHECK(run.world().speed_rpm() == 0);
  }
}

TEST_CASE("below the limits no interlock trips", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::shock, 5, 6);
  auto text = small_plan;
  text.replace(text.find("\"acceleration_m_s2\": 300"), 24, "\"acceleration_m_s2\": 486");
  CHECK(run.go(text).ending.outcome == Outcome::pass);
}

TEST_CASE("an E-stop or an open guard at connect keeps the bench from arming",
          "[sequences][safety]") {
  const auto fault = GENERATE(MirrorFault::estop, MirrorFault::guard_open);
  Run run;
  run.world().schedule(fault, 0);
  CHECK(run.go().ending.error_kind == ErrorKind::safety_trip);
  for (const auto& [time_s, speed_rpm] : run.world().speed_commands()) CHECK(speed_rpm == 0);
}

TEST_CASE("a device that dies or freezes is lost as soon as its value is stale",
          "[sequences][safety]") {
  struct Case {
    MirrorFault fault;
    std::string device;
  };
  const auto [fault, device] = GENERATE(values<Case>({
      {MirrorFault::drive_dead, "drive"},
      {MirrorFault::brake_dead, "brake"},
      {MirrorFault::torque_sensor_dead, "torque sensor"},
      {MirrorFault::torque_sensor_frozen, "torque sensor"},
      {MirrorFault::accelerometers_dead, "accelerometers"},
      {MirrorFault::accelerometers_frozen, "accelerometers"},
      {MirrorFault::safety_dead, "safety inputs"},
  }));
  CAPTURE(device);
  Run run;
  run.world().schedule(fault, 12);
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK(summary.ending.error_kind == ErrorKind::device_lost);
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains(device));
  CHECK(run.world().speed_rpm() == 0);
  CHECK(run.world().brake_torque_Nm() == 0);
  CHECK(summary.shaft_stopped);
  CHECK(summary.points.at(0).status == "interrupted");
  if (fault == MirrorFault::drive_dead) {
    CHECK_FALSE(run.stopped_s() > 12);  // the command cannot get through: the watchdog stops it
  } else {
    CHECK(run.stopped_s() == Approx(12.3).margin(0.1));
    CHECK(summary.brake_released == (fault != MirrorFault::brake_dead));
  }
}

TEST_CASE("one missed answer is no lost device", "[sequences]") {
  const auto fault = GENERATE(MirrorFault::drive_dead, MirrorFault::brake_dead,
                              MirrorFault::torque_sensor_dead, MirrorFault::safety_dead);
  Run run;
  run.world().schedule(fault, 12, 12.06);
  CHECK(run.go().ending.outcome == Outcome::pass);
}

TEST_CASE("a drive whose reading is frozen is found by the torque sensor's angle",
          "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_frozen, 1.9);  // at 605 rpm, before it goes to 1815
  const auto& summary = run.go();
  CHECK(summary.ending.error_kind == ErrorKind::device_lost);
  CHECK_THAT(summary.ending.reason, Catch::Contains("the drive reports 605 rpm"));
  CHECK(run.world().speed_rpm() == 0);
}

TEST_CASE("a drive or brake that reports its own fault ends the run", "[sequences][safety]") {
  const auto fault = GENERATE(MirrorFault::drive_tripped, MirrorFault::brake_tripped);
  Run run;
  run.world().schedule(fault, 5, 5.2);
  const auto& summary = run.go();
  CHECK(summary.ending.error_kind == ErrorKind::device_lost);
  CHECK_THAT(summary.ending.reason, Catch::Contains("tripped"));
  CHECK(run.stopped_s() <= 5.1);
  CHECK(summary.shaft_stopped);
}
