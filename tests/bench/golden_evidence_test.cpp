#include "bench/qualification/golden_evidence.hpp"

#include <catch2/catch.hpp>

#include "tests/bench/golden_unit_runs.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using test::demand;
using test::GoldenRuns;
using test::of_a_week;
using test::only;
using test::Place;
using test::section;

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

TEST_CASE("a loose cable leaves no mark on the golden unit's chart", "[bench][station]") {
  GoldenRuns runs;
  runs.enter_sound(20);
  runs.enter(300, [](Judgement& judgement) { judgement.ending.outcome = Outcome::invalid; });
  CHECK_THAT(only(runs.reasons(demand())), Contains("ended INVALID"));
  runs.enter(3.02);
  CHECK(runs.reasons(demand()).empty());
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
