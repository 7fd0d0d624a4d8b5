#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/units.hpp"
#include "sequences/bench_loop.hpp"
#include "tests/sequences/run_fixture.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;
using test::small_plan;

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
