#include "bench/located.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/explanation_json.hpp"
#include "bench/report/explanation_sections.hpp"

using namespace rvbench;
using analysis::LockedTo;
using analysis::ResidualCluster;
using Catch::Matchers::Contains;

namespace {

const ResidualCluster pins{"input_torque", "N·m",  LockedTo::shaft,
                           12.893,         12.893, {"605 rpm, 0 %", "605 rpm, 75 %"},
                           0.0062,         166,    235};
const ResidualCluster mean{"input_torque", "N·m", LockedTo::nothing, 0, 0, {"605 rpm, 0 %"},
                           -0.02,          -9};
const ResidualCluster mains{"input_torque", "N·m", LockedTo::time, 50, 50, {"605 rpm, 0 %"},
                            0.001,          7};

}  // namespace

TEST_CASE("a place is told by what it stays with", "[bench][explain][locate]") {
  CHECK(bench::place_text(pins) == "input_torque order 12.893");
  CHECK(bench::place_text(mean) == "input_torque mean");
  CHECK(bench::place_text(mains) == "input_torque 50 Hz");
  const ResidualCluster late{
      "motor_force", "N", LockedTo::programme, 1.125, 1.875, {"cycle"}, 3, 9};
  CHECK(bench::place_text(late) == "motor_force at 1.12 to 1.88 s");
  ResidualCluster wide = pins;
  wide.last = 12.901;
  CHECK(bench::place_text(wide) == "input_torque order 12.893 to 12.901");
}

TEST_CASE("the page says what was off before, and what still is", "[bench][explain][locate]") {
  const std::string html = bench::report::located_section({240, 3, {pins, mean}, {mean, mains}});
  CHECK_THAT(html, Contains("Of 240 means and lines"));
  CHECK_THAT(html, Contains("order 12.893") && Contains("2 conditions") && Contains("(166 σ)"));
  CHECK_THAT(html, Contains("within chance"));
  CHECK_THAT(html, Contains("50 Hz"));
  CHECK(bench::report::located_section({}).empty());
  bench::Located noisy{240, 3, {pins}, {}};
  noisy.noise = {{"input_torque", "mean, from record to record", "N·m", 0.0021}};
  CHECK_THAT(bench::report::located_section(noisy),
             Contains("input_torque: mean, from record to record 0.0021 N·m"));
}

TEST_CASE("explain.json tells places, or null of a plant without any", "[bench][explain][locate]") {
  bench::ExplainFacts facts;
  const auto told = [&] {
    return nlohmann::json::parse(explanation_to_json({}, facts)).at("located");
  };
  CHECK(told().is_null());
  facts.located = {240, 3, {pins}, {}};
  facts.located.noise = {{"input_torque", "mean, from record to record", "N·m", 0.0021}};
  CHECK(told().at("cells") == 240);
  CHECK(told().at("after").empty());
  CHECK(told().at("noise").at(0).at("standard_deviation") == 0.0021);
  const auto place = told().at("before").at(0);
  CHECK(place.at("locked_to") == "order");
  CHECK(place.at("first") == 12.893);
  CHECK(place.at("conditions").size() == 2);
  CHECK(place.at("standard_errors") == 166);
}

TEST_CASE("what stays clearly off under most conditions is no chance", "[bench][explain][locate]") {
  using analysis::ExplainVerdict;
  const auto weighed = [](std::size_t conditions, std::vector<ResidualCluster> after) {
    analysis::Explanation e;
    bench::weigh_what_stays({240, conditions, {}, std::move(after)}, e);
    return e;
  };
  SECTION("a line under two of three conditions: something is missing") {
    const auto e = weighed(3, {pins});
    CHECK(e.verdict == ExplainVerdict::none_of_the_above);
    CHECK_THAT(e.reason, Contains("input_torque order 12.893"));
  }
  SECTION("under two of nine it may be one of them that is odd") {
    CHECK(weighed(9, {pins}).verdict == ExplainVerdict::null);
  }
  SECTION("not clearly off") {
    ResidualCluster slight = pins;
    slight.standard_errors = -5;
    slight.together = 6.5;
    CHECK(weighed(3, {slight}).verdict == ExplainVerdict::null);
  }
  SECTION("a little under each of five of nine is a lot") {
    ResidualCluster weak = pins;
    weak.conditions = {"1", "2", "3", "4", "5"};
    weak.standard_errors = 5.4;
    weak.together = 10;
    CHECK(weighed(9, {weak}).verdict == ExplainVerdict::none_of_the_above);
  }
  SECTION("one speed under all loads will do where the plant has no line") {
    ResidualCluster arms = pins;
    arms.conditions = {"1815 rpm, 0 %", "1815 rpm, 75 %", "1815 rpm, 150 %"};
    bench::Located located{240, 9, {}, {arms}};
    located.rows = {{"1815 rpm, 0 %", "1815 rpm, 150 %", "1815 rpm, 75 %"}};
    const auto verdict = [&] {
      analysis::Explanation e;
      bench::weigh_what_stays(located, e);
      return e.verdict;
    };
    CHECK(verdict() == ExplainVerdict::null);  // that line of the plant may be a little wrong
    located.after[0].is_new = true;
    CHECK(verdict() == ExplainVerdict::none_of_the_above);
    located.after[0].conditions.pop_back();
    CHECK(verdict() == ExplainVerdict::null);
  }
  SECTION("places of a programme: a single one may be a bump in the way") {
    const auto at = [](const char* programme, double time_s) {
      return ResidualCluster{"force", "N", LockedTo::programme, time_s, time_s, {programme}, 2,
                             9,       9};
    };
    CHECK(weighed(1, {at("cycle", 5.6)}).verdict == ExplainVerdict::null);
    const auto e = weighed(2, {at("fast", 1), at("slow", 2), at("slow", 3)});
    CHECK(e.verdict == ExplainVerdict::none_of_the_above);
    CHECK_THAT(e.reason, Contains("force at 2 s of slow"));
    CHECK(weighed(9, {at("fast", 1), at("slow", 2), at("slow", 3)}).verdict ==
          ExplainVerdict::null);
  }
  SECTION("an answer stays") {
    analysis::Explanation named;
    named.verdict = ExplainVerdict::named;
    bench::weigh_what_stays({240, 3, {}, {pins}}, named);
    CHECK(named.verdict == ExplainVerdict::named);
  }
}
