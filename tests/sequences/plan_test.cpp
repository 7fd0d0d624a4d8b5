#include "sequences/plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "hal/types/measure.hpp"
#include "sequences/timeline.hpp"
#include "tests/sequences/run_fixture.hpp"
#include "tests/support/replaced.hpp"
#include "tests/support/this_build.hpp"

using namespace rvbench;
using sequences::TestPlan;
using test::faults_of;

namespace {

TestPlan shipped(const std::string& name) {
  auto read =
      sequences::read_plan((test::source_dir() / "sequences/plans/").string() + name + ".json");
  REQUIRE(std::holds_alternative<TestPlan>(read));
  return std::get<TestPlan>(std::move(read));
}

std::string small_with(const std::string& from, const std::string& to) {
  return test::replaced(test::small_plan, from, to);
}

}  // namespace

TEST_CASE("the acceptance plan is the article's procedure", "[sequences][plan]") {
  const TestPlan plan = shipped("rv20e_acceptance");
  const auto points = plan.points();
  REQUIRE(points.size() == 63);
  CHECK(points[0].speed_rpm == 605);
  CHECK(points[6].load_pct == 150);  // at each speed all loads ...
  CHECK(points[7].load_pct == 0);    // ... and again
  CHECK(points[7].repeat == 2);
  CHECK(points[20].speed_rpm == 605);
  CHECK(points[21].speed_rpm == 1210);
  CHECK(points[62].speed_rpm == 1815);

  // 600 s of warm-up; 21 points each of 48, 24 and 16 s; 2 s of settling before each.
  CHECK(sequences::planned_duration_s(plan) == Approx(600 + 21 * (48 + 24 + 16) + 63 * 2));
  double most_Nm = 0;
  double recorded_s = 0;
  for (const auto& segment : sequences::timeline(plan)) {
    most_Nm = std::max(most_Nm, segment.output_torque_Nm);
    if (segment.recorded) recorded_s += segment.duration_s;
  }
  CHECK(most_Nm == Approx(250.5));
  CHECK(recorded_s == Approx(1848));
}

TEST_CASE("a plan lets no channel fail unless it says so", "[sequences][plan]") {
  CHECK(shipped("quick").channels_may_fail == 0);
  const std::string lenient = small_with("{", "{\"channels_may_fail\": 2, ");
  const auto plan = sequences::parse_plan(hal::ConfigReader::from_text(lenient, "plan.json"));
  REQUIRE(plan.index() == 0);
  CHECK(std::get<0>(plan).channels_may_fail == 2);
  CHECK(sequences::plan_to_json(std::get<0>(plan)).find("\"channels_may_fail\": 2") !=
        std::string::npos);
  CHECK_FALSE(faults_of(small_with("{", "{\"channels_may_fail\": -1, ")).empty());
}

TEST_CASE("the quick plan has four points", "[sequences][plan]") {
  CHECK(shipped("quick").points().size() == 4);
  CHECK(sequences::planned_duration_s(shipped("quick")) == Approx(5 + 2 * (24 + 16) + 4 * 2));
}

TEST_CASE("the hysteresis plan is one point, beyond the rated torque", "[sequences][plan]") {
  const TestPlan plan = shipped("rv20e_hysteresis");
  REQUIRE(plan.points().size() == 1);
  CHECK(plan.points()[0].load_pct > 100);
  CHECK(sequences::timeline(plan).back().output_torque_Nm == Approx(1.5 * 167));
  CHECK(plan_to_json(test::plan_of(plan_to_json(plan))) == plan_to_json(plan));
}

TEST_CASE("a resolved plan spells out every default and reads back the same", "[sequences][plan]") {
  for (const char* name : {"rv20e_acceptance", "quick"}) {
    const std::string once = plan_to_json(shipped(name));
    const TestPlan again = test::plan_of(once);
    CHECK(plan_to_json(again) == once);
    CHECK(again.points().size() == shipped(name).points().size());
    for (const char* key : {"watchdog_max_s", "torque_band_Nm", "load_tolerance_pct", "order",
                            "standstill_rpm", "component"}) {
      CHECK_THAT(once, Catch::Contains('"' + std::string(key) + '"'));
    }
  }
}

TEST_CASE("a randomised matrix has the same points in another order, by its seed",
          "[sequences][plan]") {
  const auto points = [](const std::string& order) {
    std::vector<std::pair<double, double>> list;
    const auto text =
        small_with("\"loads_pct\": [100]", "\"loads_pct\": [0, 25, 50, 75, 100, 125], " + order);
    const TestPlan plan = test::plan_of(text);
    CHECK(plan_to_json(test::plan_of(plan_to_json(plan))) == plan_to_json(plan));
    for (const auto& point : plan.points()) list.emplace_back(point.speed_rpm, point.load_pct);
    return list;
  };
  const auto nested = points("\"order\": \"nested\"");
  const auto one = points("\"order\": \"randomised\", \"seed\": 1");
  CHECK(one == points("\"order\": \"randomised\", \"seed\": 1"));
  CHECK(one != points("\"order\": \"randomised\", \"seed\": 2"));
  CHECK(one != nested);
  CHECK(std::set(one.begin(), one.end()) == std::set(nested.begin(), nested.end()));
}

TEST_CASE("every fault of a plan is told at once", "[sequences][plan]") {
  CHECK(faults_of("{\n"
                  "  \"name\": \"bad\",\n"
                  "  \"specimen\": {\"kinematics\": \"rv20e\", \"gear_ratio\": 0.5},\n"
                  "  \"interlocks\": {\"input_speed_rpm\": 2200, \"input_torque_Nm\": 8,\n"
                  "    \"acceleration_m_s2\": 300, \"housing_temp_degC\": 60,\n"
                  "    \"stale_after\": 0.3},\n"
                  "  \"setup\": [{\"phase\": \"conect\"}],\n"
                  "  \"main\": [{\"phase\": \"matrix\", \"speed_rpm\": [605],\n"
                  "    \"loads_pct\": [-25],\n"
                  "    \"record\": {\"output_turns\": 2}}],\n"
                  "  \"limits\": [{\"measure\": \"acceleration_peak\", \"unit\": \"g\",\n"
                  "    \"max\": \"high\"}]\n"
                  "}\n") ==
        "plan.json:3: /specimen/gear_ratio: 0.5 is below 1.01\n"
        "plan.json:3: /specimen/rated_output_torque_Nm: this key is missing\n"
        "plan.json:4: /interlocks/stale_after_s: this key is missing\n"
        "plan.json:6: /interlocks/stale_after: unknown key, did you mean \"stale_after_s\"?\n"
        "plan.json:7: /setup/0/phase: there is no such phase, did you mean \"connect\"?\n"
        "plan.json:8: /main/0/speeds_rpm: this key is missing\n"
        "plan.json:8: /main/0/speed_rpm: unknown key, did you mean \"speeds_rpm\"?\n"
        "plan.json:9: /main/0/loads_pct/0: -25 is below 0\n"
        "plan.json:10: /main/0/record/output_turns: 2 is below 4\n"
        "plan.json:11: /limits/0/why: this key is missing\n"
        "plan.json:12: /limits/0/max: expected a number, found \"high\"\n");
}

TEST_CASE("of a plan that lacks nearly all every part is asked for", "[sequences][plan]") {
  const std::string faults = faults_of("{\"main\": []}");
  for (const std::string part : {"name", "specimen", "interlocks", "setup"}) {
    CHECK_THAT(faults, Catch::Contains("plan.json:1: /" + part + ": this key is missing"));
  }
  CHECK_THAT(faults_of(small_with("\"load_pct\": 50", "\"load_pc\": 50")),
             Catch::Contains("/setup/1/load_pct: this key is missing") &&
                 Catch::Contains("/setup/1/load_pc: unknown key, did you mean \"load_pct\"?"));
}

TEST_CASE("a plan that contradicts itself is refused", "[sequences][plan]") {
  CHECK(faults_of(test::small_plan) == "");
  CHECK_THAT(faults_of(small_with("\"input_speed_rpm\": 2200", "\"input_speed_rpm\": 1815")),
             Catch::Contains("1815 is not above the plan's fastest speed, 1815 rpm"));
  CHECK_THAT(faults_of(small_with("\"input_torque_Nm\": 8", "\"input_torque_Nm\": 1")),
             Catch::Contains("1 is not above what the plan's largest load takes, 1.38 N·m"));
  CHECK_THAT(faults_of(small_with("{\"phase\": \"connect\"},", "")),
             Catch::Contains("\"connect\" comes once, as the first phase of setup"));
  CHECK_THAT(faults_of(small_with("\"main\": [", "\"main\": [{\"phase\": \"connect\"},")),
             Catch::Contains("/main/0/phase: \"connect\" comes once"));
  CHECK_THAT(faults_of(small_with("\"loads_pct\": [100]",
                                  "\"loads_pct\": [100], "
                                  "\"settling\": {\"hold_s\": 40}")),
             Catch::Contains("/main/0/settling/timeout_s: must be above hold_s"));
  CHECK_THAT(faults_of(small_with("[1815]", "[]")),
             Catch::Contains("/main/0/speeds_rpm: must not be empty"));
  CHECK_THAT(faults_of(small_with("[1815]", "[605, 99999]")),
             Catch::Contains("/main/0/speeds_rpm/1: 99999 is above 10000"));
  CHECK_THAT(faults_of(small_with("[1815]", "[1815], \"order\": \"x\"")),
             Catch::Contains("/main/0/order: expected one of"));
  CHECK_THAT(faults_of(small_with("\"connect\"", "\"connect\", \"watchdog_max_s\": 60")),
             Catch::Contains("/setup/0/watchdog_max_s: 60 is above 2"));
  std::string many = "[0";
  for (int i = 0; i < 200; ++i) many += ",1";
  CHECK_THAT(faults_of(small_with("\"loads_pct\": [100]",
                                  "\"loads_pct\": " + many + "], \"repeats\": 1000")),
             Catch::Contains("201000 points are more than 10000"));
}

namespace {

std::string small_with_limit(const std::string& limit) {
  return small_with("\"setup\": [", "\"limits\": [{" + limit + "}], \"setup\": [");
}

std::string faults_of_limit(const std::string& limit) { return faults_of(small_with_limit(limit)); }

}  // namespace

TEST_CASE("every measure can be limited in each of its units", "[sequences][plan]") {
  const auto recording_all_with = [](const std::string& limit) {
    return small_with("\"main\": [", "\"limits\": [{" + limit + R"(}], "main": [
      {"phase": "hysteresis_loop", "hold_pct": 150, "peak_pct": 125, "speed_rpm": 30,
       "ramp_rpm_per_s": 4},
      {"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [0], "repeats": 2,
       "record": {"output_turns": 4}},)");
  };
  for (const Measure& measure : measures()) {
    for (const std::string_view unit : measure.units) {
      const std::string limit = "\"measure\": \"" + std::string(measure.name) + "\", \"unit\": \"" +
                                std::string(unit) + "\", \"max\": 1, \"why\": \"ten units\"";
      CAPTURE(limit);
      const TestPlan plan = test::plan_of(recording_all_with(limit));
      REQUIRE(plan.limits.size() == 1);
      CHECK(plan.limits[0].measure == measure.name);
      CHECK(plan_to_json(test::plan_of(plan_to_json(plan))) == plan_to_json(plan));
    }
  }
}

TEST_CASE("a limit on what is not measured, or in a wrong unit, is a fault of the plan",
          "[sequences][plan]") {
  using Catch::Contains;
  CHECK_THAT(faults_of_limit(R"("measure": "kurtosi", "max": 4, "why": "x")"),
             Contains("/limits/0/measure: \"kurtosi\" is not measured") &&
                 Contains("did you mean \"kurtosis\"?"));
  CHECK_THAT(faults_of_limit(R"("measure": "kurtosis", "unit": "g", "max": 4, "why": "x")"),
             Contains("kurtosis is a pure number: its unit is \"1\", not \"g\""));
  CHECK_THAT(faults_of_limit(R"("measure": "band_rms", "unit": "mm", "max": 4, "why": "x")"),
             Contains("/limits/0/unit: expected one of \"m/s²\", \"g\"; found \"mm\""));
  CHECK_THAT(faults_of_limit(R"("measure": "fm4", "max": 4)"),
             Contains("/limits/0/why: this key is missing"));
  CHECK_THAT(faults_of_limit(R"("measure": "fm4", "component": "crank", "max": 4, "why": "x")"),
             Contains("fm4 is narrowed by \"of\""));
}

TEST_CASE("a bound that no value can be beyond is a fault of the plan", "[sequences][plan]") {
  using Catch::Contains;
  const auto [limit, told] = GENERATE(table<std::string, std::string>({
      // <x⁴> is at least <x²>², and a peak at least the rms.
      {R"("measure": "kurtosis", "max": 0.9, "why": "x")", "/limits/0/max: 0.9 is below 1"},
      {R"("measure": "band_kurtosis", "max": 0.9, "why": "x")", "/limits/0/max: 0.9 is below 1"},
      {R"("measure": "fm4", "max": 0.9, "why": "x")", "/limits/0/max: 0.9 is below 1"},
      {R"("measure": "crest_factor", "min": 0.9, "why": "x")", "/limits/0/min: 0.9 is below 1"},
      {R"("measure": "efficiency", "min": 1.2, "why": "x")", "/limits/0/min: 1.2 is above 1"},
      {R"("measure": "fm0", "max": -1, "why": "x")", "/limits/0/max: -1 is below 0"},
      {R"("measure": "fm0", "max": NaN, "why": "x")", "NaN"},
      {R"("measure": "fm0", "max": 1e999, "why": "x")", "number overflow"},
  }));
  CAPTURE(limit);
  CHECK_THAT(faults_of_limit(limit), Contains(told));
}

TEST_CASE("two limits that no value keeps to are a fault of the plan", "[sequences][plan]") {
  using Catch::Contains;
  const std::string at_least = R"("measure": "fm0", "min": 5, "why": "a"}, {)";
  CHECK_THAT(faults_of_limit(at_least + R"("measure": "fm0", "max": 4, "why": "b")"),
             Contains("/limits/1/max: no fm0 keeps to it and to the min 5 that \"a\" asks for"));
  CHECK_THAT(faults_of_limit(R"("measure": "band_rms", "unit": "g", "max": 1, "why": "a"}, {)"
                             R"("measure": "band_rms", "unit": "m/s²", "min": 9.9, "why": "b",)"
                             R"("of": "above the meshes")"),
             Contains("/limits/1/min: no band_rms keeps to it and to the max 1"));
  for (const char* other :
       {R"("measure": "fm0", "max": 6, "why": "b")", R"("measure": "fm4", "max": 4, "why": "b")"}) {
    CAPTURE(other);
    CHECK(test::plan_of(small_with_limit(at_least + other)).limits.size() == 2);
  }
  CHECK(test::plan_of(small_with_limit(R"("measure": "fm0", "of": "a", "min": 5, "why": "a"}, {)"
                                       R"("measure": "fm0", "of": "b", "max": 4, "why": "b")"))
            .limits.size() == 2);
}

TEST_CASE("two bounds of one kind on the same thing are a fault of the plan", "[sequences][plan]") {
  using Catch::Contains;
  const std::string at_most = R"("measure": "fm0", "of": "a", "max": 5, "why": "a"}, {)";
  CHECK_THAT(faults_of_limit(at_most + R"("measure": "fm0", "of": "a", "max": 4, "why": "b")"),
             Contains("/limits/1/max: fm0 has a max already, 5 \"a\""));
  const std::string depth = R"("measure": "modulation_depth", "component": "crank", "max": 0.1)";
  CHECK_THAT(faults_of_limit(depth + R"(, "why": "a"}, {)" + depth + R"(, "why": "b")"),
             Contains("/limits/1/max: modulation_depth has a max already, 0.1"));
  for (const char* other : {R"("measure": "fm0", "of": "a", "min": 4, "why": "b")",
                            R"("measure": "fm0", "of": "b", "max": 4, "why": "b")",
                            R"("measure": "fm0", "max": 4, "why": "b")"}) {
    CAPTURE(other);
    CHECK(test::plan_of(small_with_limit(at_most + other)).limits.size() == 2);
  }
}

TEST_CASE("a limit on what no phase of the plan shows is a fault of the plan",
          "[sequences][plan]") {
  using Catch::Contains;
  const std::string measure =
      GENERATE("lost_motion", "torsional_stiffness", "hysteresis_width", "na4");
  const std::string unit = std::string(find_measure(measure)->units.front());
  const std::string limit =
      "\"measure\": \"" + measure + "\", \"unit\": \"" + unit + "\", \"max\": 9, \"why\": \"x\"";
  CHECK_THAT(faults_of_limit(limit),
             Contains("/limits/0/measure: " + measure + " needs " +
                      (measure == "na4" ? "a point that main records more than once"
                                        : "a hysteresis_loop phase, and main has none")));
}

TEST_CASE("a plan that only winds the output up cannot limit what turns", "[sequences][plan]") {
  const std::string wound = plan_to_json(shipped("rv20e_hysteresis"));
  const auto limits = wound.find("\"limits\"");
  const auto faults_with = [&](const std::string& limit) {
    return faults_of(wound.substr(0, limits) + "\"limits\": [{" + limit + "}]}");
  };
  CHECK_THAT(faults_with(R"("measure": "fm4", "max": 6, "why": "x")"),
             Catch::Contains("/limits/0/measure: fm4 needs a shaft that turns steadily"));
  CHECK(faults_with(R"("measure": "lost_motion", "unit": "arcmin", "max": 1, "why": "x")") == "");
}

TEST_CASE("a limit bounds from one side", "[sequences][plan]") {
  using Catch::Contains;
  const TestPlan plan = test::plan_of(
      small_with_limit(R"("measure": "efficiency", "min": 0.8, "why": "the maker says so")"));
  CHECK(plan.limits.at(0).min == 0.8);
  CHECK(std::isnan(plan.limits.at(0).max));
  CHECK(plan_to_json(test::plan_of(plan_to_json(plan))) == plan_to_json(plan));
  CHECK_THAT(faults_of_limit(R"("measure": "fm0", "min": 1, "max": 4, "why": "x")"),
             Contains("/limits/0/max: beside \"min\""));
  CHECK_THAT(faults_of_limit(R"("measure": "modulation_depth", "min": 1, "why": "x")"),
             Contains("/limits/0/min: no depth is too small"));
  CHECK_THAT(faults_of_limit(R"("measure": "fm0", "why": "x")"),
             Contains("/limits/0/max: this key is missing"));
}
