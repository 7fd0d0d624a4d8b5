#include <catch2/catch.hpp>

#include "sequences/timeline.hpp"
#include "tests/sequences/run_fixture.hpp"
#include "tests/support/replaced.hpp"

using namespace rvbench;
using Catch::Matchers::Contains;
using test::Run;
using test::small_plan;

namespace {

std::string winding_plan(const std::string& phase) {
  std::string text = small_plan;
  const auto from = text.find("\"main\"");
  return text.substr(0, from) + "\"main\": [" + phase + "]}";
}

const std::string winding = R"({"phase": "hysteresis_loop", "hold_pct": 150, "peak_pct": 125,
  "speed_rpm": 30, "ramp_rpm_per_s": 5, "loops": 2, "timeout_s": 40})";

std::string with(const std::string& from, const std::string& to) {
  return winding_plan(test::replaced(winding, from, to));
}

std::string fault_of(const std::string& text) {
  const auto read = sequences::parse_plan(hal::ConfigReader::from_text(text, "plan.json"));
  const auto* faults = std::get_if<std::vector<hal::ConfigFault>>(&read);
  REQUIRE(faults != nullptr);
  REQUIRE(faults->size() == 1);
  return describe("plan.json", faults->front());
}

}  // namespace

TEST_CASE("a hysteresis loop is one point, held and wound", "[sequences][plan]") {
  const auto plan = test::plan_of(winding_plan(winding));
  REQUIRE(plan.points().size() == 1);
  CHECK(plan.points().front().speed_rpm == 30);
  CHECK(plan.points().front().load_pct == 125);
  const auto segments = sequences::timeline(plan);
  const auto& wound = segments.back();
  CHECK(wound.recorded);
  CHECK(wound.output_torque_Nm == Approx(1.5 * 167));  // what the brake must hold
  CHECK(wound.duration_s == 40);
  CHECK_FALSE(segments[segments.size() - 2].recorded);

  const std::string once = plan_to_json(plan);
  CHECK(plan_to_json(test::plan_of(once)) == once);
  const std::string by_default =
      plan_to_json(test::plan_of(with(", \"loops\": 2, \"timeout_s\": 40", "")));
  CHECK_THAT(by_default, Contains("\"loops\": 4") && Contains("\"least_speed_rpm\": 0.5") &&
                             Contains("\"timeout_s\": 600"));
}

TEST_CASE("a brake that would give way is a fault of the plan", "[sequences][plan]") {
  CHECK_THAT(fault_of(with("\"peak_pct\": 125", "\"peak_pct\": 150")),
             Contains("/main/0/peak_pct: 150 is not below hold_pct"));
  CHECK_THAT(fault_of(with("\"speed_rpm\": 30", "\"speed_rpm\": 3000")),
             Contains("/main/0/speed_rpm"));
  CHECK_THAT(fault_of(with("\"loops\": 2", "\"least_speed_rpm\": 30")),
             Contains("/main/0/least_speed_rpm: must be below speed_rpm"));
  CHECK_THAT(fault_of(with("\"hold_pct\": 150, ", "")), Contains("hold_pct"));
  CHECK_THAT(fault_of(with("\"loops\"", "\"lops\"")), Contains("did you mean \"loops\""));
}

// The mirrored bench shows the same torque whichever way it turns: it never comes to the other
// peak.
TEST_CASE("a reducer that is not wound up leaves a point that says so, and a bench at rest",
          "[sequences]") {
  Run run;
  const auto& summary = run.go(winding_plan(winding));
  CHECK(summary.ending.outcome == Outcome::invalid);
  REQUIRE(summary.points.size() == 1);
  CHECK(summary.points[0].status == "not_wound_up");
  CHECK(summary.shaft_stopped);
  CHECK(summary.brake_released);
  double fastest = 0, slowest = 0, least = 100;
  for (const auto& [time_s, speed_rpm] : run.world().speed_commands()) {
    if (time_s < 4) continue;  // the warm-up
    fastest = std::max(fastest, speed_rpm);
    slowest = std::min(slowest, speed_rpm);
    if (speed_rpm != 0) least = std::min(least, std::abs(speed_rpm));
  }
  CHECK(fastest <= 30);
  CHECK(slowest == Approx(-30));  // and no further
  CHECK(least == Approx(0.5));    // nor so slow that it were a stop
}

TEST_CASE("a hysteresis loop that was recorded before is not wound again", "[sequences]") {
  Run run;
  const std::string matrix = R"({"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
    "record": {"output_turns": 4}})";
  const auto& summary = run.go(winding_plan(winding + ", " + matrix), 1);
  CHECK(summary.ending.outcome == Outcome::pass);
  REQUIRE(summary.points.size() == 1);
  CHECK(summary.points[0].point == 1);
}
