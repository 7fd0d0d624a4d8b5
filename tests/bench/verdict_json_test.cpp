#include "bench/verdict_json.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/bench/judgements.hpp"

namespace rvbench::bench {

TEST_CASE("verdict.json has the keys that other tools rely on", "[bench]") {
  const auto json = nlohmann::json::parse(judgement_to_json(test::failed_run()));
  CHECK(json.at("verdict") == "FAIL");
  CHECK(json.at("quality").is_array());
  const auto& finding = json.at("findings").at(0);
  for (const char* key :
       {"component", "mechanism", "table4_item", "order", "frequency_Hz", "points", "imfs",
        "statistic", "p_value", "severity", "confidence", "advice"}) {
    INFO(key);
    CHECK(finding.contains(key));
  }
  CHECK(finding.at("component") == "input_shaft");
  CHECK(finding.at("imfs") == nlohmann::json({1, 2}));
  CHECK(finding.at("table4_item") == "drive shaft");
}

TEST_CASE("indicators are told per point and channel, one entry per measure", "[bench]") {
  const auto json = nlohmann::json::parse(judgement_to_json(test::failed_run()));
  const auto& point = json.at("points").at(0);
  const auto& bands = point.at("channels").at(0).at("indicators").at(1);
  CHECK(bands.at("name") == "band_rms");
  CHECK(bands.at("unit") == "m/s²");
  CHECK(bands.at("values").at("sun-planet mesh") == 1.5);
  CHECK(point.at("channels").at(0).at("indicators").at(0).at("values").at("whole") == 3.1);
  CHECK(point.at("indicators").at(0).at("values").at("input_torque") == 0.12);
}

TEST_CASE("a verdict without intervals, growth and hypotheses that are not shown is read",
          "[bench]") {
  auto json = nlohmann::ordered_json::parse(judgement_to_json(test::failed_run()));
  json.erase("not_shown");
  for (const char* key : {"severity_interval", "growth_with_load", "growth_with_speed",
                          "growth_fits", "growth_p_value", "cannot_tell_from", "may_follow_from"}) {
    json["findings"][0].erase(key);
  }
  for (auto& point : json["points"]) {
    for (auto& score : point["scores"]) {
      score.erase("depth2_variance");
      score.erase("channel_amplitudes");
    }
  }
  const auto again = judgement_from_json(json.dump());
  REQUIRE(again);
  CHECK(again->diagnosis.findings.at(0).severity == 0.6);
  CHECK(std::isnan(again->diagnosis.findings.at(0).severity_low));
  CHECK(again->diagnosis.findings.at(0).growth_fits);
  CHECK(again->diagnosis.not_shown.empty());
}

TEST_CASE("a verdict without indicators is read, and its limits without a place", "[bench]") {
  auto json = nlohmann::ordered_json::parse(judgement_to_json(test::failed_run()));
  for (auto& point : json["points"]) {
    point.erase("indicators");
    for (auto& channel : point["channels"]) channel.erase("indicators");
  }
  for (auto& limit : json["limits"]) {
    limit.erase("of");
    limit.erase("min");
    limit.erase("points");
    limit.erase("not_measured_at");
  }
  const auto again = judgement_from_json(json.dump());
  REQUIRE(again);
  CHECK(again->points.at(0).examination.channels.at(0).indicators.empty());
  CHECK(std::isnan(again->limits.at(0).min));
  CHECK(again->limits.at(0).lacking.empty());
}

TEST_CASE("what a finding may follow from, and how well it grows, come back", "[bench]") {
  Judgement judgement = test::failed_run();
  analysis::Finding& finding = judgement.diagnosis.findings.front();
  finding.growth = {};
  CHECK(
      nlohmann::json::parse(judgement_to_json(judgement))["findings"][0]["growth_fits"].is_null());
  finding.growth.load = {-1, 0.2};
  finding.growth_fits = false;
  finding.growth_p_value = 0.01;
  finding.may_follow_from = "planet_gear: tooth_damage";
  const auto again = judgement_from_json(judgement_to_json(judgement));
  REQUIRE(again);
  const analysis::Finding& read = again->diagnosis.findings.at(0);
  CHECK_FALSE(read.growth_fits);
  CHECK(read.growth_p_value == 0.01);
  CHECK(read.may_follow_from == "planet_gear: tooth_damage");
}

TEST_CASE("what is not known is null, not zero", "[bench]") {
  Judgement judgement = test::failed_run();
  judgement.facts.duration_s = not_known;
  judgement.facts.seed.reset();
  judgement.diagnosis.findings.front().table4_item.clear();
  const auto json = nlohmann::json::parse(judgement_to_json(judgement));
  CHECK(json.at("run").at("duration_s").is_null());
  CHECK(json.at("seed").is_null());
  CHECK(json.at("findings").at(0).at("table4_item").is_null());
  const auto& limit = json.at("limits").at(0);
  CHECK(limit.at("component").is_null());
  CHECK(limit.at("of").is_null());
  CHECK(limit.at("where") == "recording.h5#000, accel_1x");
}

TEST_CASE("a judgement read back says the same", "[bench]") {
  const Judgement judgement = test::failed_run();
  const std::string text = judgement_to_json(judgement);
  const auto again = judgement_from_json(text);
  REQUIRE(again);
  CHECK(judgement_to_json(*again) == text);
  CHECK(again->facts.seed == 18446744073709551615ULL);
  CHECK(std::isnan(again->points.at(1).torque_Nm));
  CHECK(again->points.at(0).examination.channels.at(0).imf_correlation.size() == 9);
}

TEST_CASE("text that is no verdict is not read as one", "[bench]") {
  CHECK_FALSE(judgement_from_json(""));
  CHECK_FALSE(judgement_from_json("[]"));
  CHECK_FALSE(judgement_from_json("{\"verdict\": \"PASS\"}"));
}

TEST_CASE("names that are not UTF-8 do not break the document", "[bench]") {
  Judgement judgement = test::failed_run();
  judgement.points.front().examination.source = "caf\xe9.mat";
  CHECK(nlohmann::json::accept(judgement_to_json(judgement)));
}

}  // namespace rvbench::bench
