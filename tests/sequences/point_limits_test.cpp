#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/set_point.hpp"
#include "sequences/limits_on_plan.hpp"
#include "sequences/plan.hpp"
#include "tests/sequences/run_fixture.hpp"

using namespace rvbench;
using Catch::Contains;
using sequences::Limit;
using sequences::TestPlan;

namespace {

// Two speeds at two loads, of which one is recorded twice.
std::string plan_with(const std::string& limits) {
  std::string text = test::small_plan;
  const std::string matrix = R"("speeds_rpm": [1815], "loads_pct": [100],)";
  text.replace(text.find(matrix), matrix.size(),
               R"("speeds_rpm": [1210, 1815], "loads_pct": [50, 100],)");
  const std::string more = R"(, {"phase": "matrix", "speeds_rpm": [1815], "loads_pct": [100],
                                "record": {"output_turns": 4}}], "limits": [)";
  text.replace(text.rfind(']'), 1, more + limits + "]");
  return text;
}

std::string faults_of(const std::string& limits) { return test::faults_of(plan_with(limits)); }

std::string limit(const std::string& keys) {
  return R"({"measure": "kurtosis", "why": "x", )" + keys + "}";
}

}  // namespace

TEST_CASE("a limit is for the points whose speed and load it states", "[sequences][plan]") {
  const TestPlan plan = test::plan_of(
      plan_with(limit(R"("max": 4)") + ", " + limit(R"("max": 5, "speed_rpm": 1815)") + ", " +
                limit(R"("max": 6, "load_pct": 50)") + ", " +
                limit(R"("max": 3, "speed_rpm": 1815, "load_pct": 100)")));
  REQUIRE(plan.limits.size() == 4);
  CHECK(plan.limits[0].at.is_any());
  CHECK(plan.limits[1].at == SetPoint{1815, std::nullopt});
  CHECK(plan.limits[2].at == SetPoint{std::nullopt, 50});
  CHECK(plan.limits[3].at == SetPoint{1815, 100});
  CHECK(plan_to_json(test::plan_of(plan_to_json(plan))) == plan_to_json(plan));
}

TEST_CASE("a set point names its points, and any names none", "[types]") {
  const SetPoint any, fast{1815, std::nullopt}, one{1815, 100};
  CHECK(text_of(one) == "1815 rpm, 100 % load");
  CHECK(text_of(fast) == "1815 rpm");
  CHECK(text_of(SetPoint{std::nullopt, 0}) == "0 % load");
  CHECK(at_text(one) == " at 1815 rpm, 100 % load");
  CHECK(text_of(any).empty());
  CHECK(at_text(any).empty());
  CHECK(any.includes(not_known, not_known));
  CHECK(fast.includes(1815, not_known));
  CHECK_FALSE(one.includes(1815, not_known));
  CHECK_FALSE(one.includes(1210, 100));
  CHECK(one.includes(double(1815.0F), double(100.0F)));
  CHECK(covers(fast, one));
  CHECK(covers(any, fast));
  CHECK_FALSE(covers(one, fast));
  CHECK(overlap(fast, SetPoint{std::nullopt, 50}));
  CHECK_FALSE(overlap(one, SetPoint{std::nullopt, 50}));
}

TEST_CASE("a limit at a point that the plan does not record is a fault that names the points",
          "[sequences][plan]") {
  CHECK_THAT(faults_of(limit(R"("max": 4, "speed_rpm": 605)")),
             Contains("/limits/0/speed_rpm: no point of the plan shows kurtosis at 605 rpm: there "
                      "are 1210 rpm, 50 % load; 1210 rpm, 100 % load; 1815 rpm"));
  CHECK_THAT(faults_of(limit(R"("max": 4, "load_pct": 75)")),
             Contains("/limits/0/load_pct: no point of the plan shows kurtosis at 75 % load"));
  CHECK_THAT(faults_of(limit(R"("max": 4, "speed_rpm": "fast", "load_pct": -1)")),
             Contains("/limits/0/speed_rpm") && Contains("/limits/0/load_pct: -1 is below 0"));
  CHECK(faults_of(limit(R"("max": 4, "speed_rpm": 1815, "load_pct": 50)")) == "");
}

TEST_CASE("what takes repeats can be limited at a point that is repeated alone",
          "[sequences][plan]") {
  const std::string na4 = R"({"measure": "na4", "max": 9, "why": "x", "speed_rpm": )";
  CHECK(faults_of(na4 + R"(1815, "load_pct": 100})") == "");
  CHECK_THAT(
      faults_of(na4 + "1210}"),
      Contains("no point of the plan shows na4 at 1210 rpm: there are 1815 rpm, 100 % load"));
  const TestPlan plan = test::plan_of(plan_with(""));
  CHECK(set_points_of(*find_measure("na4"), plan) == std::vector<SetPoint>{{1815, 100}});
  CHECK(set_points_of(*find_measure("kurtosis"), plan) ==
        std::vector<SetPoint>{{1210, 50}, {1210, 100}, {1815, 50}, {1815, 100}});
  CHECK(set_points_of(*find_measure("lost_motion"), plan).empty());
}

TEST_CASE("a limit for all points and one for a point stand side by side", "[sequences][plan]") {
  const std::string all = limit(R"("max": 4)"), at_one = R"("max": 5, "speed_rpm": 1815)";
  CHECK(faults_of(all + ", " + limit(at_one)) == "");
  CHECK(faults_of(limit(at_one) + ", " + limit(R"("max": 5, "speed_rpm": 1210)")) == "");
  CHECK_THAT(faults_of(limit(at_one) + ", " + limit(R"("max": 6, "speed_rpm": 1815)")),
             Contains("/limits/1/max: kurtosis at 1815 rpm has a max already, 5"));
}

TEST_CASE("limits contradict each other only where both hold", "[sequences][plan]") {
  const std::string least = limit(R"("min": 5, "speed_rpm": 1815)");
  CHECK(faults_of(least + ", " + limit(R"("max": 4, "speed_rpm": 1210)")) == "");
  for (const char* most : {R"("max": 4)", R"("max": 4, "load_pct": 50)"}) {
    CAPTURE(most);
    CHECK_THAT(faults_of(least + ", " + limit(most)),
               Contains("/limits/1/max: no kurtosis keeps to it and to the min 5"));
  }
}

TEST_CASE("a depth is of no point alone", "[sequences][plan]") {
  CHECK_THAT(faults_of(R"({"measure": "modulation_depth", "max": 0.1, "why": "x",
                           "speed_rpm": 1815})"),
             Contains("/limits/0/speed_rpm: a depth is concluded from all points together"));
}

TEST_CASE("limits from elsewhere are held against the points of a plan", "[sequences][plan]") {
  const TestPlan plan = test::plan_of(plan_with(""));
  Limit far{"kurtosis", "", "1", 4, "x"};
  far.at.speed_rpm = 605;
  Limit near = far;
  near.at.speed_rpm = 1210;
  const auto faults = limits_without_points({near, far}, plan);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].pointer == "/limits/1/speed_rpm");
  CHECK(limits_without_points({near}, plan).empty());
}
