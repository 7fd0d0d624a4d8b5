#include "sequences/sequencer.hpp"

#include <catch2/catch.hpp>

#include "tests/sequences/run_fixture.hpp"

using namespace rvbench;
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
