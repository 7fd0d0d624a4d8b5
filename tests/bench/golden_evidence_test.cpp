#include "bench/qualification/golden_evidence.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "bench/ledger.hpp"
#include "bench/qualification/golden_runs.hpp"
#include "bench/qualification/qualification.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

namespace {

GoldenUnitDemand demand() {
  GoldenUnitDemand demand;
  demand.serial = "GOLD";
  demand.plan = "quick";
  demand.max_age_h = 24;
  demand.indicators = {{"kurtosis"}};
  return demand;
}

GoldenUnitDemand of_a_week() {
  GoldenUnitDemand asked = demand();
  asked.max_age_h = 24 * 7;
  return asked;
}

// Of the station that is asked.
QualificationSection section(const GoldenUnitDemand& asked) {
  QualificationSection section;
  section.station = "EOL 3";
  section.rig_kind = "bench";
  section.golden_unit = asked;
  return section;
}

// Where its runs were made.
struct Place {
  std::string rig_kind = "bench";
  std::string station = "EOL 3";
};

// Its runs, one a day from 1 January on, of one point at 605 rpm and 100 %.
class GoldenRuns {
 public:
  void enter(
      double kurtosis, const std::function<void(Judgement&)>& change = [](auto&) {}) {
    Judgement judgement = of_today(kurtosis);
    change(judgement);
    begin(judgement.facts);
    end(judgement);
  }

  Judgement of_today(double kurtosis) const {
    Judgement judgement = test::passed_run();
    judgement.facts.serial = "GOLD";
    judgement.facts.started_utc = fmt::format("202601{:02}T120000Z", day_ + 1);
    judgement.points[0].examination.channels[0].indicators[0].value = kurtosis;
    return judgement;
  }

  void begin(const RunFacts& facts) {
    newest_ = create_run_folder(root_.path(), facts.serial, facts.started_utc);
    write_file(newest_ / "start.json",
               run_begin_to_json({facts.serial, facts.started_utc, ++day_}));
    write_file(newest_ / "rig.json",
               fmt::format(R"({{"rig": "{}", "qualification": {{"station": "{}", "golden_unit": )"
                           R"({{"serial": "{}", "plan": "{}"}}}}}})",
                           place_.rig_kind, place_.station, facts.serial, facts.plan));
    write_file(newest_ / "plan.json", R"({"name": ")" + facts.plan + "\"}");
    write_file(newest_ / "recording.h5", "");
    go_on(facts);
  }

  void end(const Judgement& judgement) {
    write_file(newest_ / "verdict.json", judgement_to_json(judgement));
    write_sums(newest_);
    const QualificationSection here = section_of(judgement.facts);
    REQUIRE(enter_golden_end(root_.path(), &here, newest_).empty());
  }

  void go_on(const RunFacts& facts) const {
    const QualificationSection here = section_of(facts);
    REQUIRE(enter_golden_begin(root_.path(), &here, newest_, plan_).empty());
  }

  void move_to(const Place& place) { place_ = place; }
  void take_plan(const std::string& sha256) { plan_ = sha256; }
  std::filesystem::path newest() const { return newest_; }

  // 3 and what chance adds, without a pattern that a rule would see.
  void enter_sound(int count) {
    constexpr std::array off{-1.0, 1.0, 0.5, -0.5, 0.2, -0.8, 0.9, -0.2, 0.6, -0.6};
    for (int i = 0; i < count; ++i) enter(3 + 0.1 * off[static_cast<std::size_t>(i) % off.size()]);
  }

  std::vector<std::string> reasons(const GoldenUnitDemand& asked, double hours_later = 1) const {
    const int hours = 12 + static_cast<int>(hours_later);
    const std::string now = fmt::format("202601{:02}T{:02}0000Z", day_ + hours / 24, hours % 24);
    return golden_reasons(gather_evidence(root_.path(), section(asked)).golden, asked, now);
  }

  const std::filesystem::path& root() const { return root_.path(); }

 private:
  // Of where they are made.
  QualificationSection section_of(const RunFacts& facts) const {
    QualificationSection here = section(demand());
    here.rig_kind = place_.rig_kind;
    here.station = place_.station;
    here.golden_unit->serial = facts.serial;
    here.golden_unit->plan = facts.plan;
    return here;
  }

  ScratchFolder root_;
  Place place_;
  std::filesystem::path newest_;
  std::string plan_ = "of the one text";
  int day_ = 0;
};

std::string only(const std::vector<std::string>& reasons) {
  REQUIRE(reasons.size() == 1);
  return reasons[0];
}

}  // namespace

TEST_CASE("a golden unit that reads as ever says nothing against the station", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  CHECK(runs.reasons(demand()).empty());
  GoldenUnitDemand of_point = demand();
  of_point.points = {{605, 100}};
  CHECK(runs.reasons(of_point).empty());
}

TEST_CASE("a golden unit that moves is told with indicator, rule, centre and limit",
          "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.9);
  CHECK_THAT(only(runs.reasons(demand())),
             Contains("golden unit GOLD: kurtosis is 3.9, out of control: western_electric_1") &&
                 Contains("(centre 3.001, 3 sigma"));
  // Its weighted mean remembers so large a jump for a while, and then it does not count any more.
  runs.enter(3.02);
  CHECK_THAT(only(runs.reasons(demand())), Contains("EWMA"));
  runs.enter_sound(5);
  CHECK(runs.reasons(demand()).empty());
}

TEST_CASE("without enough runs of the golden unit there is no chart, and without any no unit",
          "[bench][station]") {
  GoldenRuns runs;
  CHECK(only(runs.reasons(demand())) ==
        "golden unit GOLD: it has no run of plan quick on this station");
  runs.enter_sound(9);
  CHECK_THAT(only(runs.reasons(demand())),
             Contains("9 runs of the golden unit: its chart takes 20"));
  GoldenUnitDemand of_eight = demand();
  of_eight.baseline_runs = 8;
  CHECK(runs.reasons(of_eight).empty());
}

TEST_CASE("a golden run counts for its hours, and must have passed", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  CHECK(runs.reasons(demand(), 24).empty());
  CHECK_THAT(only(runs.reasons(demand(), 25)), Contains("25 h ago, and counts for 24 h"));
  runs.enter(3.02, [](Judgement& judgement) {
    judgement.ending = {Outcome::fail, ErrorKind::none, "input_shaft: misalignment"};
  });
  CHECK_THAT(only(runs.reasons(demand())), Contains("ended FAIL: input_shaft: misalignment"));
}

TEST_CASE("runs of another plan or another unit are not the golden unit's", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  runs.enter(9, [](Judgement& judgement) { judgement.facts.plan = "another"; });
  runs.enter(9, [](Judgement& judgement) { judgement.facts.serial = "A17"; });
  CHECK(runs.reasons(of_a_week()).empty());
}

TEST_CASE("a charted indicator that the newest run lacks is missing, not in control",
          "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02, [](Judgement& judgement) {
    judgement.points[0].examination.channels[0].indicators.erase(
        judgement.points[0].examination.channels[0].indicators.begin());
  });
  CHECK(only(runs.reasons(demand())) == "golden unit GOLD: its newest run has no kurtosis");
}

TEST_CASE("what the golden unit showed elsewhere is nothing to this station", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  for (const Place& elsewhere : {Place{"sim", "EOL 3"}, Place{"bench", "EOL 4"}}) {
    runs.move_to(elsewhere);
    runs.enter(9);  // far off, and not of this station
    CHECK(runs.reasons(of_a_week()).empty());
  }
  CHECK_THAT(only(runs.reasons(demand())), Contains("its newest run is of 2026-01-21"));
}

TEST_CASE("a golden run that came to no verdict is to be repeated", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(3.02);
  SECTION("as a device was lost") {
    runs.enter(9, [](Judgement& judgement) {
      judgement.ending = {Outcome::error, ErrorKind::device_lost, "a device"};
    });
    CHECK_THAT(only(runs.reasons(of_a_week())),
               Contains("its newest run (2026-01-22 12:00:00) ended ERROR: a device: repeat it"));
  }
  SECTION("as its process was killed") {
    runs.begin(runs.of_today(3.02).facts);
    CHECK_THAT(only(runs.reasons(of_a_week())), Contains("did not come to its end: repeat it"));
  }
  SECTION("and was gone on with") {
    Judgement judgement = runs.of_today(3.02);
    runs.begin(judgement.facts);
    judgement.ending = {Outcome::aborted, ErrorKind::none, "stopped"};
    runs.end(judgement);
    CHECK_THAT(only(runs.reasons(of_a_week())), Contains("ended ABORTED: stopped"));
    runs.go_on(judgement.facts);
    CHECK_THAT(only(runs.reasons(of_a_week())), Contains("did not come to its end: repeat it"));
    judgement.ending = {Outcome::pass, ErrorKind::none, "all within limits"};
    runs.end(judgement);
    CHECK(runs.reasons(demand()).empty());
    return;
  }
  runs.enter(3.02);
  CHECK(runs.reasons(demand()).empty());
}

TEST_CASE("runs that did not pass make no baseline", "[bench][station]") {
  GoldenRuns runs;
  for (int run = 0; run < 5; ++run) {
    runs.enter(9, [](Judgement& judgement) { judgement.ending.outcome = Outcome::fail; });
  }
  runs.enter_sound(20);
  CHECK_THAT(only(runs.reasons(demand())), Contains("20 runs of the golden unit: its chart takes"));
  runs.enter(3.02);
  CHECK(runs.reasons(demand()).empty());
}

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

TEST_CASE("a loose cable leaves no mark on the golden unit's chart", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(300, [](Judgement& judgement) { judgement.ending.outcome = Outcome::invalid; });
  CHECK_THAT(only(runs.reasons(demand())), Contains("ended INVALID"));
  runs.enter(3.02);
  CHECK(runs.reasons(demand()).empty());
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

TEST_CASE("the golden unit's own run does not wait for the golden unit", "[bench][station]") {
  QualificationSection section;
  section.station = "EOL 3";
  section.golden_unit = demand();
  section.calibration = CalibrationDemand{{"accel_1x"}};
  const auto reasons_for = [&](const std::string& serial) {
    return qualification_of(section, {}, {}, "20260105T120000Z", serial).reasons().size();
  };
  CHECK(reasons_for("A17") == 2);
  CHECK(reasons_for("GOLD") == 1);  // the calibration is missing for it, too
}

}  // namespace rvbench::bench
