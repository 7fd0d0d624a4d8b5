#include <catch2/catch.hpp>
#include <cmath>

#include "sim/rv_plant.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using test::BenchRun;

namespace {

using Catch::Matchers::Contains;

const std::string winding_plan = R"({
  "name": "winding",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 121, "rated_output_torque_Nm": 167},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.3},
  "setup": [{"phase": "connect"}],
  "main": [{"phase": "hysteresis_loop", "hold_pct": 150, "peak_pct": 125, "speed_rpm": 30,
            "ramp_rpm_per_s": 5, "loops": 3, "timeout_s": 120}],
  "limits": [{"measure": "lost_motion", "unit": "arcmin", "max": 1, "why": "the maker's"},
             {"measure": "torsional_stiffness", "unit": "N·m/arcmin", "min": 12, "why": "ours"}]
})";

// The plant file's numbers in series: both cycloid stages, the shaft from carrier to brake, and the
// sun's two meshes of 8e7 N/m at 5.3 mm, seen through i = 121.
double stiffness_Nm_per_arcmin() {
  const double meshes = 2 * 8e7 * 5.3e-3 * 5.3e-3 * 121 * 121;
  return 1 / (1 / 168e3 + 1 / 6e4 + 1 / meshes) * std::numbers::pi / (180 * 60);
}

double value_of(const bench::Judgement& judgement, std::string_view measure) {
  for (const auto& indicator : judgement.points.at(0).examination.indicators) {
    if (indicator.measure == measure) return indicator.value;
  }
  return not_known;
}

// The same, after one point of a matrix.
const std::string both_plan = R"({
  "name": "both",
  "specimen": {"kinematics": "rv20e", "gear_ratio": 121, "rated_output_torque_Nm": 167},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.3},
  "setup": [{"phase": "connect"}],
  "main": [{"phase": "matrix", "speeds_rpm": [1210], "loads_pct": [50],
            "settling": {"hold_s": 0.5}, "record": {"output_turns": 4}},
           {"phase": "hysteresis_loop", "hold_pct": 150, "peak_pct": 125, "speed_rpm": 30,
            "ramp_rpm_per_s": 5, "loops": 3, "timeout_s": 120}],
  "limits": [{"measure": "acceleration_rms", "unit": "g", "max": 1, "why": "ours"},
             {"measure": "torque_ripple", "max": 2, "why": "ours"},
             {"measure": "lost_motion", "unit": "arcmin", "max": 1, "why": "ours"}]
})";

}  // namespace

TEST_CASE("a plan of both a matrix and a winding passes a good reducer", "[spec]") {
  if (test::too_long_under_sanitizer()) return;
  BenchRun run({}, sim::with_holding_brake(sim::rv20e_bench()));
  const bench::Judgement& judgement = run.go(both_plan);
  INFO(judgement.ending.reason);
  CHECK(judgement.ending.outcome == Outcome::pass);
  REQUIRE(judgement.points.size() == 2);
  CHECK_FALSE(judgement.points[0].examination.of_hysteresis);
  CHECK(judgement.points[1].examination.of_hysteresis);
  REQUIRE(judgement.limits.size() == 3);
  for (const bench::LimitCheck& check : judgement.limits) {
    CAPTURE(check.measure);
    CHECK(check.passed);
    CHECK(check.points == 1);
  }
  const std::string junit = bench::read_file(run.folder() / "junit.xml").value_or("");
  CHECK_THAT(junit, Contains(R"(failures="0" errors="0" skipped="0")"));
}

SCENARIO("a run winds the simulated reducer and tells what it yields", "[spec]") {
  if (test::too_long_under_sanitizer()) return;
  GIVEN("a brake that holds at standstill") {
    BenchRun run({}, sim::with_holding_brake(sim::rv20e_bench()));
    const bench::Judgement& judgement = run.go(winding_plan);
    INFO(judgement.ending.reason);
    THEN("the verdict rests on lost motion and stiffness") {
      CHECK(judgement.ending.outcome == Outcome::pass);
      REQUIRE(judgement.limits.size() == 2);
      CHECK(judgement.limits[0].passed);
      CHECK(judgement.limits[1].passed);
      CHECK(judgement.facts.shaft_stopped);
      CHECK(judgement.facts.brake_released);
    }
    THEN("they are those of the plant") {
      const double stiffness = stiffness_Nm_per_arcmin();
      CHECK(value_of(judgement, "torsional_stiffness") == Approx(stiffness).epsilon(0.03));
      CHECK(value_of(judgement, "lost_motion") == Approx(2 * 0.03 * 167 / stiffness).epsilon(0.05));
      CHECK(value_of(judgement, "hysteresis_width") == Approx(0).margin(0.3));
    }
    THEN("the report shows the loop") {
      const auto html = bench::read_file(run.folder() / "report.html");
      REQUIRE(html);
      CHECK_THAT(*html, Contains("<h2>Hysteresis</h2>") && Contains("torsion at the output"));
    }
  }
  GIVEN("one that creeps, as the simulated bench has it") {
    BenchRun run;
    const bench::Judgement& judgement = run.go(winding_plan);
    THEN("nothing is told, and it is no pass") {
      CHECK(judgement.ending.outcome == Outcome::invalid);
      CHECK(std::isnan(value_of(judgement, "lost_motion")));
      CHECK(judgement.facts.shaft_stopped);
    }
  }
}
