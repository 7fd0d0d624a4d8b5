#include "sequences/sequencer.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/units.hpp"
#include "sequences/bench_loop.hpp"
#include "tests/sequences/run_fixture.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;
using test::small_plan;

TEST_CASE("an undisturbed run measures every point and leaves the bench at rest", "[sequences]") {
  Run run;
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::pass);
  CHECK(summary.shaft_stopped);
  CHECK(summary.brake_released);
  CHECK(run.world().speed_rpm() == 0);
  CHECK(run.world().brake_torque_Nm() == 0);
  REQUIRE(summary.points.size() == 1);
  CHECK(summary.points[0].status == "ok");
  CHECK(summary.points[0].speed_rpm == Approx(1815).epsilon(1e-4));
  CHECK(summary.points[0].torque_Nm == Approx(167.0 / 121).epsilon(1e-6));
  CHECK(run.recording.results.size() == 1);
  CHECK(summary.duration_s == Approx(run.rig.clock->now_s()));
  CHECK(run.observer.doings.size() == 3);  // warm up, settle, record
}

TEST_CASE("a record holds the turns asked for, on both sample clocks", "[sequences]") {
  Run run;
  run.go();
  const auto& point = run.recording.points.at(0);
  // 4 output turns at 15 rpm are 16 s.
  const double both_from_s = std::max(point.accelerations_from_s, point.torque_from_s);
  const double both_to_s =
      std::min(point.accelerations_to_s, point.torque_from_s + double(point.torque.size()) / 1000);
  CHECK(both_to_s - both_from_s >= 16.0);
  CHECK(both_to_s - both_from_s <= 16.05);
  const double turns =
      (point.torque.back().angle_rad - point.torque.front().angle_rad) / units::two_pi / 121;
  CHECK(turns == Approx(4).margin(0.01));
  CHECK(double(point.scans) / 4960 == Approx(16).margin(0.05));
}

TEST_CASE("a slipping motor is recorded longer, for turns count and not seconds", "[sequences]") {
  Run run({.slip_pct = 4});
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::pass);
  CHECK(summary.points.at(0).speed_rpm == Approx(0.96 * 1815).epsilon(1e-4));
  CHECK(double(run.recording.points.at(0).scans) / 4960 == Approx(16 / 0.96).margin(0.05));
}

TEST_CASE("the brake is released at standstill, not before", "[sequences]") {
  Run run;
  run.go();
  // From 1815 rpm at 500 rpm/s the ramp takes 3.63 s; standstill must then last 0.3 s.
  const double stopped_s = run.stopped_s();
  CHECK(run.world().brake_released_s() - stopped_s > 3.63);
  CHECK(run.world().brake_released_s() - stopped_s < 3.63 + 1.0);
}

TEST_CASE("stop at any moment ends ABORTED, with the shaft stopped", "[sequences]") {
  Run run;
  run.stop.request_stop();
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::aborted);
  CHECK(exit_code(summary.ending) == 50);
  CHECK(summary.shaft_stopped);
  CHECK(summary.brake_released);
  for (const auto& [time_s, speed_rpm] : run.world().speed_commands()) CHECK(speed_rpm == 0);
}

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

TEST_CASE("an exception inside a phase ends in teardown", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_throws, 12, 12.1);
  const auto& summary = run.go();
  CHECK(summary.ending.outcome == Outcome::error);
  CHECK_THAT(summary.ending.reason, Catch::Contains("a defect of the driver"));
  CHECK(run.stopped_s() == Approx(12).margin(0.1));
  CHECK(run.world().speed_rpm() == 0);
  CHECK(run.world().brake_torque_Nm() == 0);
  CHECK(summary.brake_released);
  CHECK(summary.points.at(0).status == "interrupted");
}

TEST_CASE("a setup that fails is torn down all the same", "[sequences][safety]") {
  SECTION("devices that do not answer are all named") {
    Run run;
    run.world().schedule(MirrorFault::brake_dead, 0);
    run.world().schedule(MirrorFault::safety_dead, 0);
    const auto& summary = run.go();
    CHECK(summary.ending.error_kind == ErrorKind::device_lost);
    CHECK_THAT(summary.ending.reason, Catch::Contains("brake"));
    CHECK_THAT(summary.ending.reason, Catch::Contains("safety"));
    CHECK(summary.shaft_stopped);
    CHECK_FALSE(std::isnan(run.stopped_s()));
  }
  SECTION("a drive without a safe watchdog is not armed") {
    const auto watchdog = GENERATE(hal::DriveWatchdog{0, true}, hal::DriveWatchdog{1, false},
                                   hal::DriveWatchdog{2.5, true});
    Run run({.watchdog = watchdog});
    const auto& summary = run.go();
    CHECK(exit_code(summary.ending) == 30);
    CHECK_THAT(summary.ending.reason, Catch::Contains("refused to arm"));
    for (const auto& [time_s, speed_rpm] : run.world().speed_commands()) CHECK(speed_rpm == 0);
    CHECK(summary.shaft_stopped);
  }
  SECTION("a plan beyond the rig is refused before anything turns") {
    Run run({.max_speed_rpm = 1500});
    const auto& summary = run.go();
    CHECK(exit_code(summary.ending) == 30);
    CHECK(summary.ending.reason == "the plan asks for 1815 rpm, the drive can do 1500 rpm");
  }
}

TEST_CASE("with everything dead the teardown still ends, at its time-out", "[sequences][safety]") {
  Run run;
  for (const auto fault :
       {MirrorFault::drive_dead, MirrorFault::brake_dead, MirrorFault::torque_sensor_dead,
        MirrorFault::safety_dead, MirrorFault::accelerometers_dead}) {
    run.world().schedule(fault, 12);
  }
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_FALSE(summary.shaft_stopped);  // nobody saw it
  CHECK_FALSE(summary.brake_released);
  run.world().advance();
  CHECK(run.world().speed_rpm() == 0);  // but the watchdogs did it
  CHECK(run.world().brake_torque_Nm() == 0);
  CHECK(run.rig.clock->now_s() > 12 + 30);
  CHECK(run.rig.clock->now_s() < 12 + 30 + 5);
}

TEST_CASE("without standstill the brake is released at the time-out", "[sequences][safety]") {
  Run run({.ramp_rpm_s = 40});  // at 800 rpm when it is pressed: 20 s to standstill
  run.world().schedule(MirrorFault::estop, 20);
  auto text = small_plan;
  text.insert(text.rfind('}'), R"(, "teardown": {"standstill_timeout_s": 10})");
  const auto& summary = run.go(text);
  CHECK(exit_code(summary.ending) == 40);
  CHECK_FALSE(summary.shaft_stopped);
  CHECK(summary.brake_released);
  CHECK(run.world().brake_released_s() - run.stopped_s() == Approx(10).margin(0.2));
}

TEST_CASE("what does not settle makes the run INVALID, and the run goes on", "[sequences]") {
  const auto fault = GENERATE(MirrorFault::uneven_speed, MirrorFault::brake_slack);
  Run run;
  run.world().schedule(fault, 2, 33);  // over the first point's 30 s of patience
  auto text = small_plan;
  text.replace(text.find("[100]"), 5, "[100, 50]");
  const auto& summary = run.go(text);
  CHECK(summary.ending.outcome == Outcome::invalid);
  REQUIRE(summary.points.size() == 2);
  CHECK(summary.points[0].status == "unsettled");
  CHECK(summary.points[1].status == "ok");
  CHECK(summary.shaft_stopped);
}

TEST_CASE("lost samples make the run INVALID", "[sequences]") {
  Run run;
  run.world().schedule(MirrorFault::scans_lost, 12, 12.1);
  const auto& summary = run.go();
  CHECK(summary.points.at(0).status == "samples_lost");
  CHECK(exit_code(summary.ending) == 20);
}

TEST_CASE("a record that does not come by its turns is too short", "[sequences]") {
  Run run;
  const auto plan = test::plan_of(small_plan);
  sequences::BenchLoop loop(plan, run.rig, run.recording, run.observer, {}, 0);
  REQUIRE_FALSE(plan.setup[0]->run(loop, plan.specimen));
  REQUIRE_FALSE(loop.record_point(0, 100, 1.0));  // at standstill
  REQUIRE(loop.points().size() == 1);
  CHECK(loop.points()[0].status == "too_short");
  CHECK(run.recording.results.at(0).status == "too_short");
  const auto samples = run.recording.points.at(0).torque.size();
  CHECK((samples >= 999 && samples <= 1001));  // 1 s at 1 kHz, between two ticks
}

TEST_CASE("a recording that cannot be written ends the run", "[sequences]") {
  Run run;
  run.recording.fail_after = 100;
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains("disk full"));
  CHECK(summary.shaft_stopped);
}

TEST_CASE("a last point that does not settle and cannot be written down is ERROR, not INVALID",
          "[sequences]") {
  Run run;
  run.world().schedule(MirrorFault::uneven_speed, 2);
  run.recording.fail_end_point = true;
  const auto& summary = run.go();
  CHECK(exit_code(summary.ending) == 30);
  CHECK_THAT(summary.ending.reason, Catch::Contains("disk full"));
  CHECK(summary.shaft_stopped);
}

TEST_CASE("a resumed run warms up again and goes on at the point asked for", "[sequences]") {
  Run run;
  auto text = small_plan;
  text.replace(text.find("[100]"), 5, "[0, 50, 100]");
  const auto& summary = run.go(text, 2);
  CHECK(summary.ending.outcome == Outcome::pass);
  REQUIRE(summary.points.size() == 1);
  CHECK(summary.points[0].point == 2);
  CHECK(run.observer.doings.contains("warm up at 605 rpm, 50 %"));
  CHECK(run.recording.points.size() == 1);
}
