#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/judging.hpp"
#include "bench/junit.hpp"
#include "bench/limit_checks.hpp"
#include "bench/report/report.hpp"
#include "bench/summary.hpp"
#include "bench/unit_numbers.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using sequences::Limit;

const Ending measured{Outcome::pass, ErrorKind::none, "everything was measured"};

JudgedPoint point_at(double speed_rpm, double load_pct, double kurtosis) {
  JudgedPoint point;
  point.planned_speed_rpm = speed_rpm;
  point.examination.load_pct = load_pct;
  point.examination.source = "recording.h5#" + std::to_string(int(speed_rpm));
  point.examination.resolvable = true;
  point.examination.channels = {
      {"accel_1x", "m/s²", 0.1, 1, kurtosis, {}, {}, {{"kurtosis", "", kurtosis, "1"}}}};
  return point;
}

Limit at_most(double max, const SetPoint& at = {}) {
  Limit limit{"kurtosis", "", "1", max, "50 good units"};
  limit.at = at;
  return limit;
}

const SetPoint slow{1210, 100}, fast{1815, 100};

// Kurtosis 3 when slow, 5 when fast.
Judgement judged(const std::vector<Limit>& limits) {
  Judgement judgement;
  judgement.points = {point_at(1210, 100, 3), point_at(1815, 100, 5)};
  conclude(judgement, {}, limits, measured);
  return judgement;
}

}  // namespace

TEST_CASE("a limit for a point is held against that point alone", "[bench][limits]") {
  const Judgement within = judged({at_most(4, slow), at_most(6, fast)});
  CHECK(within.ending.outcome == Outcome::pass);
  CHECK(within.limits.at(0).measured == 3);
  CHECK(within.limits.at(0).points == 1);
  CHECK(within.limits.at(1).measured == 5);

  const Judgement beyond = judged({at_most(4, fast), at_most(6, slow)});
  CHECK(beyond.ending.outcome == Outcome::fail);
  CHECK(beyond.ending.reason ==
        "kurtosis at 1815 rpm, 100 % load: 5 above its max 4 at recording.h5#1815, accel_1x");
  CHECK(beyond.limits.at(1).passed);

  const Judgement fast_only = judged({at_most(4, {1815, std::nullopt})});
  CHECK(fast_only.limits.at(0).measured == 5);
}

TEST_CASE("a limit for all points and one for a point both hold: the stricter decides",
          "[bench][limits]") {
  const Judgement stricter_point = judged({at_most(9), at_most(4, fast)});
  CHECK(stricter_point.ending.outcome == Outcome::fail);
  CHECK(stricter_point.limits.at(0).passed);
  CHECK_FALSE(stricter_point.limits.at(1).passed);

  const Judgement stricter_general = judged({at_most(4.5), at_most(9, fast)});
  CHECK(stricter_general.ending.outcome == Outcome::fail);
  CHECK(stricter_general.ending.reason ==
        "kurtosis 5 above its max 4.5 at recording.h5#1815, accel_1x");
  CHECK(stricter_general.limits.at(1).passed);

  CHECK(judged({at_most(6), at_most(6, fast)}).ending.outcome == Outcome::pass);
}

TEST_CASE("a limit at a point that was not recorded is no pass", "[bench][limits]") {
  const Judgement judgement = judged({at_most(9, {605, 100})});
  CHECK(judgement.ending.outcome == Outcome::invalid);
  CHECK_THAT(judgement.ending.reason,
             Contains("kurtosis at 605 rpm, 100 % load could not be measured"));
  CHECK(std::isnan(judgement.limits.at(0).measured));
}

TEST_CASE("what another point lacks is nothing to a limit for this one", "[bench][limits]") {
  Judgement judgement;
  judgement.points = {point_at(1210, 100, 3), point_at(1815, 100, 5)};
  judgement.points[0].examination.channels[0].indicators.clear();
  conclude(judgement, {}, {at_most(6, fast)}, measured);
  CHECK(judgement.ending.outcome == Outcome::pass);
  judgement.points[0].status = "unsettled";
  hold_against(judgement, {at_most(6)}, measured);
  CHECK(judgement.ending.outcome == Outcome::invalid);
}

TEST_CASE("other limits are held against what was concluded", "[bench][limits]") {
  Judgement judgement = judged({at_most(4)});
  CHECK(judgement.ending.outcome == Outcome::fail);
  hold_against(judgement, {at_most(6), at_most(4, slow)}, measured);
  CHECK(judgement.ending.outcome == Outcome::pass);
  CHECK(judgement.limits.size() == 2);
  hold_against(judgement, {}, {Outcome::error, ErrorKind::device_lost, "the brake is silent"});
  CHECK(judgement.ending.outcome == Outcome::error);
  CHECK(judgement.limits.empty());
}

TEST_CASE("every place that shows a limit names its points", "[bench][limits]") {
  Judgement judgement = test::failed_run();
  judgement.facts.limits_version = "2026-11";
  judgement.limits.front().at = fast;
  const std::string points = "acceleration_peak at 1815 rpm, 100 % load";

  const std::string json = judgement_to_json(judgement);
  const auto told = nlohmann::json::parse(json);
  CHECK(told.at("run").at("limits_version") == "2026-11");
  CHECK(told.at("limits").at(0).at("speed_rpm") == 1815);
  CHECK(told.at("limits").at(0).at("load_pct") == 100);
  const auto again = judgement_from_json(json);
  REQUIRE(again);
  CHECK(again->limits.front().at == fast);
  CHECK(again->facts.limits_version == "2026-11");
  CHECK(judgement_to_json(*again) == json);

  CHECK(name_of(judgement.limits.front()) == points);
  CHECK_THAT(junit_xml(judgement), Contains("name=\"" + points + "\""));
  CHECK(name_of(numbers_of(judgement).front()) == points);
  ReportInput input;
  input.judgement = judgement;
  CHECK_THAT(make_report(input), Contains("Limits, version 2026-11, in place of the plan's") &&
                                     Contains("any at 1815 rpm, 100 % load"));
  std::ostringstream out, err;
  Console console{out, err};
  print_summary(console, judgement, {}, {});
  CHECK_THAT(out.str(), Contains(points + ": 1.9 g (max 0.5 g)"));
}

TEST_CASE("a verdict without points and version reads as one for all points, of the plan",
          "[bench][limits]") {
  auto json = nlohmann::ordered_json::parse(judgement_to_json(test::failed_run()));
  CHECK(json["run"]["limits_version"].is_null());
  CHECK(json["limits"][0]["speed_rpm"].is_null());
  json["run"].erase("limits_version");
  json["limits"][0].erase("speed_rpm");
  json["limits"][0].erase("load_pct");
  const auto read = judgement_from_json(json.dump());
  REQUIRE(read);
  CHECK(read->limits.front().at.is_any());
  CHECK(read->facts.limits_version.empty());
  ReportInput input;
  input.judgement = *read;
  CHECK_THAT(make_report(input), Contains("Limits of the plan") && !Contains("any at"));
}

TEST_CASE("a number at a point is compared with other units at that point", "[bench][limits]") {
  Judgement judgement = judged({at_most(9), at_most(6, slow)});
  const auto numbers = numbers_of(judgement);
  REQUIRE(numbers.size() >= 2);
  CHECK(numbers[0].value == 5);
  CHECK(numbers[1].value == 3);
  CHECK(value_in(judgement, numbers[1]) == 3);
  judgement.points.erase(judgement.points.begin());
  CHECK(std::isnan(value_in(judgement, numbers[1])));
}

}  // namespace rvbench::bench
