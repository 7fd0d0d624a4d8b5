#include "bench/findings_stand.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/junit.hpp"
#include "bench/report/report.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/bench/summary_of.hpp"

// What was found is told as found only where something may be said of the unit.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

const char* const advice = "Stiffen, shorten or support the input shaft.";

// A run of a bad unit, both points recorded and sound.
Judgement sound_run() {
  Judgement judgement = test::failed_run();
  judgement.points.pop_back();
  judgement.limits.clear();
  return judgement;
}

Judgement ended(Judgement judgement, Outcome outcome, const std::string& reason) {
  judgement.ending = {outcome, ErrorKind::none, reason};
  return judgement;
}

Judgement clipped_run() {
  Judgement judgement = ended(sound_run(), Outcome::invalid, "accel_1x: clipped");
  judgement.points.front().examination.quality = {{"accel_1x", "clipped", true}};
  return judgement;
}

// What the user is told, wherever it is.
std::string page_of(const Judgement& judgement) {
  ReportInput input;
  input.judgement = judgement;
  return make_report(input);
}

}  // namespace

TEST_CASE(
    "nothing is advised from a record that is refused, a run that was aborted or a bench at "
    "fault",
    "[bench]") {
  const auto [judgement, why] = GENERATE(table<Judgement, std::string>(
      {{clipped_run(), "seen, but the record is refused: accel_1x: clipped"},
       {ended(sound_run(), Outcome::aborted, "stopped by the operator while judging"),
        "seen, but the run was aborted: stopped by the operator while judging"},
       {ended(sound_run(), Outcome::error, "the drive is silent"),
        "seen, but the bench was at fault: the drive is silent"}}));
  CAPTURE(why);
  CHECK_FALSE(findings_stand(judgement));
  const std::string page = page_of(judgement);
  CHECK_THAT(page, Contains(why) && Contains("input shaft: misalignment"));
  CHECK_THAT(page, !Contains(advice) && !Contains("Confidence") &&
                       !Contains("As the article reasons") && !Contains("class=\"finding\""));
  const std::string terminal = test::summary_of(judgement);
  CHECK_THAT(terminal, Contains(why) && Contains("input_shaft: misalignment"));
  CHECK_THAT(terminal,
             !Contains("advice") && !Contains("confidence") && !Contains("Second hypothesis"));
  const auto json = nlohmann::json::parse(judgement_to_json(judgement));
  CHECK(json.at("findings_stand") == false);
  const auto& finding = json.at("findings").at(0);
  CHECK(finding.at("component") == "input_shaft");
  CHECK(finding.at("confidence") == 0);
  CHECK(finding.at("advice") == "");
  CHECK_THAT(junit_xml(judgement), Contains("<skipped message=\"severity") && Contains(why) &&
                                       !Contains(advice) && !Contains("<failure"));
}

TEST_CASE("a verdict that was written before is told anew by the same rule", "[bench]") {
  auto json = nlohmann::json::parse(judgement_to_json(clipped_run()));
  json["findings"][0]["advice"] = advice;
  json["findings"][0]["confidence"] = 1;
  const auto read = judgement_from_json(json.dump());
  REQUIRE(read);
  CHECK_THAT(page_of(*read), !Contains(advice) && !Contains("Confidence"));
}

TEST_CASE("of a bad unit in sound data all is told", "[bench]") {
  const Judgement judgement = sound_run();
  CHECK(findings_stand(judgement));
  CHECK_THAT(page_of(judgement),
             Contains(advice) && Contains("Confidence</dt><dd>75 %") && !Contains("seen, but"));
  CHECK_THAT(test::summary_of(judgement),
             Contains(advice) && Contains("confidence 75 %") && !Contains("seen, but"));
  const auto json = nlohmann::json::parse(judgement_to_json(judgement));
  CHECK(json.at("findings_stand") == true);
  CHECK(json.at("findings").at(0).at("advice") == advice);
  CHECK(json.at("findings").at(0).at("confidence") == 0.75);
  CHECK_THAT(junit_xml(judgement), Contains(advice) && !Contains("<skipped"));
}

TEST_CASE("what was found of others stands where a limit or one part is open", "[bench]") {
  Judgement judgement = ended(sound_run(), Outcome::invalid, "x");
  SECTION("a limit that was not measured") {
    judgement.limits = {{"fm4", "", "1", 8, not_known, "", false, ""}};
    CHECK(lack_of(judgement) == Lack::limit_measured);
  }
  SECTION("a part that noise hides") {
    judgement.diagnosis.not_shown.front().severity_high = 0.5;  // above its limit
    CHECK(lack_of(judgement) == Lack::part_shown);
  }
  CHECK(findings_stand(judgement));
  CHECK_THAT(page_of(judgement), Contains(advice) && !Contains("seen, but"));
}

TEST_CASE("a finding is named and held against its limit in one breath", "[bench]") {
  Judgement judgement = test::passed_run();
  analysis::Finding near = test::misaligned_shaft();
  near.severity = 0.194;
  near.severity_low = 0.18;
  near.severity_high = 0.21;
  judgement.diagnosis.below_limit = {near};
  CHECK_THAT(page_of(judgement),
             Contains("input shaft: misalignment – within its limit, 0.97 of it") &&
                 Contains("its interval reaches across") && !Contains(advice));
  CHECK_THAT(
      test::summary_of(judgement),
      Contains("input_shaft: misalignment, within its limit, 0.97 of it") && !Contains("advice"));
  const auto json = nlohmann::json::parse(judgement_to_json(judgement));
  CHECK(json.at("below_limit").at(0).at("of_limit").get<double>() == Approx(0.97));
  CHECK(json.at("below_limit").at(0).at("advice") == "");
  CHECK(json.at("not_shown").at(0).at("of_limit").is_null());  // no point shows it

  const Judgement bad = sound_run();
  CHECK_THAT(test::summary_of(bad),
             Contains("input_shaft: misalignment, above its limit, 3.00 times it"));
  CHECK_THAT(page_of(bad), Contains("input shaft: misalignment – above its limit, 3.00 times it"));
}

TEST_CASE("a hair from the limit is not rounded to it", "[bench]") {
  Judgement judgement = test::passed_run();
  judgement.diagnosis.below_limit = {test::misaligned_shaft()};
  judgement.diagnosis.below_limit.front().severity = 0.1999;  // of 0.2
  CHECK_THAT(test::summary_of(judgement), Contains("within its limit, by less than 0.5 %"));
}

}  // namespace rvbench::bench
