#include "bench/qualification/golden_runs.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "bench/ledger.hpp"
#include "tests/bench/golden_unit_runs.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using test::demand;
using test::GoldenRuns;
using test::of_a_week;
using test::only;
using test::section;

TEST_CASE("what golden runs came to is not forgotten with their files", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  REQUIRE(runs.reasons(demand()).empty());
  const auto fail = [&] {
    runs.enter(9, [](Judgement& judgement) { judgement.ending.outcome = Outcome::fail; });
  };
  const auto forget_results = [&] { std::filesystem::remove(runs.root() / result_database_name); };
  const auto told = [&](const GoldenUnitDemand& asked) {
    return fmt::format("{}", fmt::join(runs.reasons(asked), "\n"));
  };
  const std::string remedy = ": put back a copy, or begin its chart anew, by \"since\"";
  SECTION("the results know them, as they were") {
    std::filesystem::remove_all(runs.newest().parent_path());
    CHECK(told(demand()).empty());
    fail();
    CHECK_THAT(told(demand()), Contains("ended FAIL"));
    std::filesystem::remove_all(runs.newest());
    CHECK_THAT(told(demand()), Contains("ended FAIL"));
  }
  SECTION("a verdict that is made better later is not what was told") {
    fail();
    CHECK_THAT(told(demand()), Contains("ended FAIL"));
    Judgement better = runs.of_today(3.02);
    write_file(runs.newest() / "verdict.json", judgement_to_json(better));
    CHECK_THAT(told(demand()), Contains("ended FAIL"));
  }
  SECTION("without folders and results the ledger tells that there were some") {
    std::filesystem::remove_all(runs.newest().parent_path());
    forget_results();
    const auto reasons = runs.reasons(demand());
    REQUIRE(reasons.size() == 2);  // not one for each
    CHECK_THAT(reasons[0], Contains("is missing") && Contains("as 20 more of its runs" + remedy));
    CHECK(reasons[1] == "golden unit GOLD: it has no run of plan quick on this station");
  }
  SECTION("one that failed, its verdict changed before anybody entered it") {
    fail();
    const auto path = runs.newest() / "verdict.json";
    write_file(path, read_file(path).value() + "\n");
    CHECK_THAT(told(demand()),
               Contains("20260122T120000Z/verdict.json was changed") && Contains(remedy));
  }
  SECTION("one that failed, with its sums and the results gone") {
    fail();
    std::filesystem::remove(runs.newest() / "SHA256SUMS");
    forget_results();
    CHECK_THAT(told(demand()), Contains("20260122T120000Z was changed: rvbench check tells what"));
  }
  SECTION("one that failed, with the ledger's newest lines gone") {
    const auto before = read_file(runs.root() / ledger_name).value();
    fail();
    write_file(runs.root() / ledger_name, before);
    CHECK_THAT(told(demand()), Contains("20260122T120000Z is in no line of ledger.jsonl"));
    GoldenUnitDemand another = demand();
    another.plan = "another";  // whose runs those are not
    CHECK(told(another) == "golden unit GOLD: it has no run of plan another on this station");
  }
}

TEST_CASE("a golden unit's chart can be begun anew", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(9);
  GoldenUnitDemand anew = demand();
  anew.since_utc = "20990101T000000Z";
  CHECK(only(runs.reasons(anew)) ==
        "golden unit GOLD: it has no run of plan quick on this station since 2099-01-01 00:00:00");
  anew.since_utc = "20260101T000000Z";
  CHECK_THAT(only(runs.reasons(anew)), Contains("kurtosis is 9"));
}

TEST_CASE("a chart that is begun anew begins behind the last run that began before", "[bench]") {
  // The first one's clock was wrong.
  Ledger ledger;
  QualificationSection asked = section(demand());
  const char* kind = "golden run begun on a rig of kind bench, plan quick with the hash 17";
  for (const char* utc : {"20300101T080000Z", "20261101T080000Z", "20261120T080000Z"}) {
    const int number = static_cast<int>(ledger.lines.size()) + 1;
    ledger.lines.push_back(
        {number, utc, kind, "EOL 3", fmt::format("GOLD/{}/start.json", utc), ""});
  }
  CHECK(golden_lines(ledger, asked).size() == 3);
  asked.golden_unit->since_utc = "20261110T000000Z";
  REQUIRE(golden_lines(ledger, asked).size() == 1);
  CHECK(golden_lines(ledger, asked)[0].folder == "GOLD/20261120T080000Z");
  asked.station = "EOL 4";
  CHECK(golden_lines(ledger, asked).empty());
}

TEST_CASE("a golden run that cannot be entered says why", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(1);
  const QualificationSection asked = section(demand());
  CHECK(enter_golden_begin(runs.root(), nullptr, runs.newest(), "").empty());
  write_file(runs.root() / ledger_name, "hello\n");
  for (const std::string& why : {enter_golden_begin(runs.root(), &asked, runs.newest(), ""),
                                 enter_golden_end(runs.root(), &asked, runs.newest())}) {
    CHECK_THAT(why,
               Contains("cannot be entered into the ledger: ") && Contains("ledger.jsonl:1: "));
  }
}

TEST_CASE("a run by a plan with the same name and another text is none of the golden unit's",
          "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(9, [](Judgement& judgement) { judgement.ending.outcome = Outcome::fail; });
  runs.take_plan("with lax limits");
  runs.enter(9);
  const auto reasons = runs.reasons(of_a_week());
  REQUIRE(reasons.size() == 2);
  CHECK_THAT(reasons[0], Contains("ended FAIL"));
  CHECK_THAT(reasons[1], Contains("1 of its runs are of a plan that is called quick, too"));
}

TEST_CASE("a golden run that the results know and the ledger has lost is not forgotten",
          "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  const auto before = read_file(runs.root() / ledger_name).value();
  runs.enter(9, [](Judgement& judgement) { judgement.ending.outcome = Outcome::fail; });
  REQUIRE_THAT(only(runs.reasons(demand())), Contains("ended FAIL"));
  write_file(runs.root() / ledger_name, before);
  SECTION("with its folder") { std::filesystem::remove_all(runs.newest()); }
  SECTION("with what says of which unit it was") {
    std::filesystem::remove(runs.newest() / "rig.json");
    std::filesystem::remove(runs.newest() / "plan.json");
  }
  CHECK_THAT(only(runs.reasons(of_a_week())), Contains("20260122T120000Z is in no line of ledger"));
}

TEST_CASE("runs on a rig that did not name the golden unit are none of it", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  const auto before = read_file(runs.root() / ledger_name).value();
  runs.begin(runs.of_today(3.02).facts);
  write_file(runs.root() / ledger_name, before);
  write_file(runs.newest() / "rig.json",
             R"({"rig": "bench", "qualification": {"station": "EOL 3"}})");
  CHECK(runs.reasons(of_a_week()).empty());
}

TEST_CASE("the newest golden run is the one that began last, where a clock was set back, too",
          "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  const auto set_back = [](Judgement& judgement) {
    judgement.facts.started_utc = "20251231T120000Z";
  };
  runs.enter(9, set_back);
  CHECK_THAT(runs.reasons(demand()).back(), Contains("kurtosis is 9"));
}

}  // namespace rvbench::bench
