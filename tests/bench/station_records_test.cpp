#include "bench/qualification/station_records.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "bench/ledger.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/ledger_lines.hpp"
#include "tests/bench/station_on_record.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using test::ScratchFolder;
using test::asks_for_calibration;
using test::asks_for_self_test;
using test::certified;
using test::keep_self_test;
using test::reasons_in;
using test::tested;

// A record that would hold for ten years more.
std::string better_than(std::string text) {
  return text.replace(text.find("20261126T"), 9, "20361126T");
}

}  // namespace

TEST_CASE("records are kept as files of their own, and read back whole", "[bench][station]") {
  const ScratchFolder root;
  SelfTestRecord record = tested("20261127T080000Z", false);
  record.steps = {{"tap", SelfTestWord::failed, "loose", {}}};
  record.steps[0].readings = {at_least("accel_1x", 0.2, 1, "m/s²"),
                              at_most("accel_1y", not_known, 1, "m/s²")};
  const std::string first = keep_self_test(root.path(), record);
  record.reason = "the later one";
  const std::string second = keep_self_test(root.path(), record);  // in the same second
  CHECK(first != second);
  keep_record(root.path(), certified("20271127T235959Z"));
  const StationRecords read = read_station_records(root.path());
  CHECK(read.damaged.empty());
  REQUIRE(read.self_tests.size() == 2);
  CHECK(read.self_tests[0].file == first);
  CHECK(read.self_tests[1].reason == "the later one");
  const auto& readings = read.self_tests[0].steps.at(0).readings;
  REQUIRE(readings.size() == 2);
  CHECK(readings[0].value == 0.2);
  CHECK(readings[0].is_least);
  CHECK(readings[0].word == SelfTestWord::failed);
  CHECK(std::isnan(readings[1].value));
  CHECK(readings[1].word == SelfTestWord::cannot_tell);
  REQUIRE(read.calibrations.size() == 1);
  CHECK(read.calibrations[0].sensitivity == 0.01021);
  CHECK(read.calibrations[0].valid_until_utc == "20271127T235959Z");
}

TEST_CASE("a record that is damaged blocks, and is named with what is wrong", "[bench][station]") {
  const ScratchFolder root;
  keep_self_test(root.path(), tested("20261127T080000Z"));
  CHECK(gather_evidence(root.path(), asks_for_self_test()).records.damaged.empty());
  LedgerPen pen(root.path());
  const auto keep = [&](const std::string& name, const std::string& text) {
    pen.keep(name, "EOL 3", "qualification/" + name + ".json", text);
  };
  keep("half", R"({"record": "self_test", "station": "EOL)");
  keep("lacks", R"({"record": "calibration", "station": "EOL 3"})");
  keep("untimely", R"({"record": "self_test", "station": "EOL 3", "rig": "bench",
    "utc": "soon", "software": "", "passed": true, "reason": "", "judged_by": {}, "steps": []})");
  keep("other", R"({"record": "gage"})");
  QualificationSection asked = asks_for_self_test();
  asked.calibration = CalibrationDemand{{"accel_1x"}};
  CHECK(gather_evidence(root.path(), asked).records.damaged.size() == 4);
  const std::string all = reasons_in(root, asked);
  CHECK_THAT(all, Contains("half.json is damaged: parse error at line 1") &&
                      Contains("key 'channel' not found") && Contains("its time is none") &&
                      Contains("no record of a station") && Contains("put back a copy"));
}

TEST_CASE("a clock that runs behind what was kept last lets nothing count, nor be kept",
          "[bench][station]") {
  const ScratchFolder root;
  test::put_in_ledger(root.path(), "20990301T080000Z");
  CHECK_THAT(reasons_in(root, asks_for_calibration()),
             Contains("its last line is of 2099-03-01 08:00:00, which is yet to come"));
  try {
    keep_record(root.path(), certified("20991127T235959Z"));
    FAIL("it was kept");
  } catch (const std::system_error& refused) {
    CHECK_THAT(reason_of(refused), Contains("say that it is right: rvbench qualify clock"));
  }
  CHECK(keeping_fault(root.path()) != "");
  CHECK(json_files_in(qualification_folder(root.path())).empty());
  keep_clock_record(root.path(), "J. Weber");
  keep_record(root.path(), certified("20991127T235959Z"));
  CHECK(reasons_in(root, asks_for_calibration()).empty());
}

TEST_CASE("what somebody said of the clock is a record like any other", "[bench][station]") {
  const ScratchFolder root;
  keep_record(root.path(), certified("20991127T235959Z"));
  const std::string before = read_file(root / ledger_name).value();
  const auto file = qualification_folder(root.path()) / keep_clock_record(root.path(), "J. Weber");
  const auto told = [&] { return reasons_in(root, asks_for_calibration()); };
  const std::string remedy = "say it again: rvbench qualify clock";
  SECTION("taken away") {
    std::filesystem::remove(file);
    CHECK_THAT(told(), Contains(" is missing") && Contains(remedy));
  }
  SECTION("in no line") {
    write_file(root / ledger_name, before);
    CHECK_THAT(told(), Contains(" is in no line") && Contains(remedy));
  }
  keep_clock_record(root.path(), "J. Weber");
  CHECK(told().empty());
}

TEST_CASE("a record that was changed, taken away or put there by hand is believed by nobody",
          "[bench][station]") {
  const ScratchFolder root;
  const std::string kept = keep_record(root.path(), certified("20261126T235959Z"));
  const auto path = qualification_folder(root.path()) / kept;
  const std::string text = read_file(path).value();
  const auto state = [&] { return reasons_in(root, asks_for_calibration()); };
  REQUIRE_THAT(state(), Contains("has expired") && !Contains("ledger"));
  SECTION("changed: it would hold for ten years more") {
    write_file(path, better_than(text));
    CHECK_THAT(state(), Contains(kept + " was changed since rvbench kept it") &&
                            Contains("has no record of it") &&
                            Contains("or enter that certificate again"));
    SECTION("the same certificate entered again takes its place") {
      keep_record(root.path(), certified("20271127T235959Z"));
      CHECK(state().empty());
    }
    SECTION("another one does not: who knows what this one told") {
      CalibrationRecord older = certified("20271127T235959Z");
      older.certificate = "K-4000";
      keep_record(root.path(), older);
      CHECK_THAT(state(), Contains("was changed"));
    }
    SECTION("a copy put back is as good as it was") {
      write_file(path, text);
      CHECK_THAT(state(), Contains("has expired") && !Contains("changed"));
    }
  }
  SECTION("taken away: what it told may have been against the station") {
    std::filesystem::remove(path);
    CHECK_THAT(state(), Contains(kept + " is missing"));
  }
  SECTION("put there by hand") {
    write_file(qualification_folder(root.path()) / "calibration-x.json", text);
    CHECK_THAT(state(), Contains("calibration-x.json is in no line of ledger.jsonl") &&
                            Contains("enter that certificate again"));
  }
  SECTION("without the ledger nothing is known") {
    std::filesystem::remove(root / ledger_name);
    CHECK_THAT(state(), Contains("is in no line of ledger.jsonl"));
  }
  SECTION("a self-test that failed is not forgotten with its line, until there is a newer one") {
    const auto told = [&] { return reasons_in(root, asks_for_self_test()); };
    keep_self_test(root.path(), tested("20261127T080000Z"));
    const auto lines = read_file(root / ledger_name).value();
    const auto failed = keep_self_test(root.path(), tested("20261127T090000Z", false));
    write_file(root / ledger_name, lines);
    CHECK_THAT(told(), Contains(failed + " is in no line") && Contains(": test anew"));
    keep_self_test(root.path(), tested("20261127T100000Z"));
    CHECK(told().empty());
  }
  SECTION("a self-test that failed is not forgotten with its file, nor by one of another rig") {
    const auto told = [&] { return reasons_in(root, asks_for_self_test()); };
    keep_self_test(root.path(), tested("20261127T080000Z"));
    const auto failed = keep_self_test(root.path(), tested("20261127T090000Z", false));
    REQUIRE_THAT(told(), Contains("was not passed"));
    std::filesystem::remove(qualification_folder(root.path()) / failed);
    CHECK_THAT(told(), Contains(failed + " is missing"));
    SelfTestRecord simulated = tested("20261127T100000Z");
    simulated.rig_kind = "sim";
    keep_self_test(root.path(), simulated);
    CHECK_THAT(told(), Contains(failed + " is missing"));
    keep_self_test(root.path(), tested("20261127T100000Z"));
    CHECK(told().empty());
  }
  SECTION("nor is it asked for where nobody asks for what it told") {
    write_file(path, better_than(text));
    QualificationSection other = asks_for_calibration();
    other.calibration = CalibrationDemand{{"input_torque"}};
    CHECK_THAT(reasons_in(root, other), !Contains(kept));
    CHECK(reasons_in(root, asks_for_self_test()) ==
          "self-test: station EOL 3 has none: rvbench qualify\n");
  }
  SECTION("another station's record is nothing to this one") {
    CalibrationRecord other = certified("20271127T235959Z");
    other.station = "EOL 4";
    const auto of_other = qualification_folder(root.path()) / keep_record(root.path(), other);
    std::filesystem::remove(of_other);
    CHECK_THAT(state(), !Contains("missing"));
  }
}

TEST_CASE("a self-test that begins counts as not passed until it has come to its end",
          "[bench][station]") {
  const ScratchFolder root;
  const auto told = [&] { return reasons_in(root, asks_for_self_test()); };
  keep_self_test(root.path(), tested("20261127T080000Z"));
  SelfTestRecord begun = tested("20261127T090000Z");
  begun.file = keep_begin(root.path(), begun).file;
  CHECK(told() ==
        "self-test: that of 2026-11-27 09:00:00 has not come to its end: if none is at work, "
        "repeat it: rvbench qualify\n");
  SECTION("killed: another that passes takes its word") {
    keep_self_test(root.path(), tested("20261127T100000Z"));
    CHECK(told().empty());
  }
  SECTION("what it came to takes its place") {
    begun.passed = GENERATE(true, false);
    begun.reason = "tap: fail";
    keep_end(root.path(), begun);
    CHECK(told().empty() == begun.passed);
    const StationRecords read = read_station_records(root.path());
    CHECK(read.damaged.empty());
    REQUIRE(read.self_tests.size() == 2);
    CHECK(read.self_tests[1].has_ended());
    CHECK(ledger_faults(root.path()).empty());
  }
  SECTION("stopped: the one before counts as ever") {
    take_back(root.path(), begun);
    CHECK(told().empty());
    CHECK(read_station_records(root.path()).self_tests.size() == 1);
    CHECK(ledger_faults(root.path()).empty());
  }
  SECTION("killed while its answer was being kept") {
    write_file(qualification_folder(root.path()) / begun.file, R"({"record": "self_test"})");
    CHECK_THAT(told(), Contains("its keeping was cut short: put back a copy, or test anew"));
  }
  SECTION("it vouches for no record in no line before it has an answer") {
    const auto stray = qualification_folder(root.path()) / "self_test-stray.json";
    write_file(
        stray,
        read_file(qualification_folder(root.path()) / "self_test-20261127T080000Z.json").value());
    REQUIRE_THAT(told(), Contains("self_test-stray.json is in no line"));
    keep_begin(root.path(), tested("20261127T093000Z"));
    CHECK_THAT(told(), Contains("self_test-stray.json is in no line"));
  }
}

TEST_CASE("of many self-tests only the newest is read to say whether a station may judge",
          "[bench][station]") {
  const ScratchFolder root;
  for (const char* utc : {"20261127T070000Z", "20261127T080000Z", "20261127T090000Z"}) {
    keep_self_test(root.path(), tested(utc));
  }
  SelfTestRecord simulated = tested("20261127T100000Z");
  simulated.rig_kind = "sim";
  keep_self_test(root.path(), simulated);
  const StationRecords newest = newest_station_records(root.path(), read_ledger(root.path()));
  REQUIRE(newest.self_tests.size() == 2);
  CHECK(newest.self_tests[0].utc == "20261127T090000Z");
  CHECK(newest.self_tests[1].rig_kind == "sim");
  CHECK(read_station_records(root.path()).self_tests.size() == 4);
  CHECK(further_station_records(root.path(), {newest.self_tests[0].file}).self_tests.size() == 3);
}

TEST_CASE("results.db has a self-test once it has come to its end", "[bench][station][results]") {
  const ScratchFolder root;
  SelfTestRecord begun = tested("20261127T090000Z");
  begun.file = keep_begin(root.path(), begun).file;
  const auto passed = [&] {
    REQUIRE(caught_up(ResultDatabase::open(root.path())));
    const auto file = SqliteFile::open(root / "results.db", "results.db");
    REQUIRE(file);
    SqlStatement query(file.value(), "SELECT count(*), total(passed) FROM self_tests");
    REQUIRE(query.next());
    return std::pair(query.integer(0), query.integer(1));
  };
  CHECK(passed() == std::pair<std::int64_t, std::int64_t>(0, 0));
  keep_end(root.path(), begun);
  CHECK(passed() == std::pair<std::int64_t, std::int64_t>(1, 1));
}

}  // namespace rvbench::bench
