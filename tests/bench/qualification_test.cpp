#include "bench/qualification/qualification.hpp"

#include <catch2/catch.hpp>

#include "bench/ledger.hpp"
#include "bench/qualification/ages.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/bench/ledger_lines.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

namespace {

const std::string now = "20261127T120000Z";
const std::vector<ChannelInfo> channels{{"accel_1x", "m/s²", "+X", 0.0102},
                                        {"input_torque", "N·m", "", not_known}};

SelfTestRecord tested(const std::string& utc, bool passed = true) {
  return {.file = "",
          .station = "EOL 3",
          .rig_kind = "bench",
          .utc = utc,
          .software = "0.1.0",
          .passed = passed,
          .reason = passed ? "every step passed" : "tap: fail",
          .judged_by = limits_of(SelfTestSpec{}),
          .steps = {}};
}

CalibrationRecord certified(const std::string& until, double sensitivity = 0.01021) {
  return {.file = "",
          .station = "EOL 3",
          .channel = "accel_1x",
          .sensitivity = sensitivity,
          .certificate = "K-4711",
          .by = "J. Weber",
          .calibrated_utc = "20251128T000000Z",
          .valid_until_utc = until,
          .entered_utc = "20251201T080000Z",
          .software = "0.1.0"};
}

QualificationSection asks_for_self_test() {
  QualificationSection section;
  section.station = "EOL 3";
  section.rig_kind = "bench";
  section.self_test.emplace();
  return section;
}

QualificationSection asks_for_calibration() {
  QualificationSection section;
  section.station = "EOL 3";
  section.calibration = CalibrationDemand{{"accel_1x"}};
  return section;
}

RequirementState only_state(const QualificationSection& section, const StationRecords& records) {
  const Qualification all = qualification_of(section, channels, {records, {}}, now);
  REQUIRE(all.requirements.size() == 1);
  return all.requirements[0];
}

RequirementState with_tests(std::vector<SelfTestRecord> records) {
  StationRecords all;
  all.self_tests = std::move(records);
  return only_state(asks_for_self_test(), all);
}

RequirementState with_calibrations(std::vector<CalibrationRecord> records) {
  StationRecords all;
  all.calibrations = std::move(records);
  return only_state(asks_for_calibration(), all);
}

// A record that would hold for ten years more.
std::string better_than(std::string text) {
  return text.replace(text.find("20261126T"), 9, "20361126T");
}

// What a folder of runs comes to at `now`, a line each.
std::string reasons_in(const ScratchFolder& root, const QualificationSection& section) {
  StationEvidence evidence = gather_evidence(root.path(), section);
  std::string told;
  for (const std::string& reason : qualification_of(section, channels, evidence, now).reasons()) {
    told += reason + "\n";
  }
  return told;
}

}  // namespace

TEST_CASE("a self-test counts for its hours, the newest one, of this station", "[bench][station]") {
  CHECK(with_tests({}).word == "missing");
  CHECK(with_tests({tested("20261127T080000Z")}).word == "fulfilled");
  CHECK_FALSE(with_tests({tested("20261127T080000Z")}).blocks);
  CHECK(with_tests({tested("20261126T130000Z")}).word == "expires");  // 1 h of 24 is left
  const auto expired = with_tests({tested("20261126T110000Z")});
  CHECK(expired.word == "expired");
  CHECK(expired.blocks);
  CHECK(expired.sentence ==
        "self-test: the newest is of 2026-11-26 11:00:00, 25 h ago, and counts for 24 h");
  // One that failed later takes the word of one that passed.
  const auto failed = with_tests({tested("20261127T080000Z"), tested("20261127T090000Z", false)});
  CHECK(failed.word == "failed");
  CHECK_THAT(failed.sentence, Contains("was not passed: tap: fail"));
  SelfTestRecord elsewhere = tested("20261127T080000Z");
  elsewhere.station = "EOL 4";
  CHECK(with_tests({elsewhere}).word == "missing");
  SelfTestRecord simulated = tested("20261127T080000Z");
  simulated.rig_kind = "sim";
  CHECK(with_tests({simulated}).word == "missing");
}

TEST_CASE("a calibration holds to the end of its last day", "[bench][station]") {
  CHECK(with_calibrations({}).word == "missing");
  CHECK(with_calibrations({certified("20271127T235959Z")}).word == "fulfilled");
  const auto soon = with_calibrations({certified("20261202T235959Z")});
  CHECK(soon.word == "expires");
  CHECK_FALSE(soon.blocks);
  CHECK_THAT(soon.sentence, Contains("valid until 2026-12-02, 5 days more"));
  CHECK(with_calibrations({certified("20261127T235959Z")}).word == "expires");  // today
  const auto expired = with_calibrations({certified("20261126T235959Z")});
  CHECK(expired.word == "expired");
  CHECK(expired.sentence ==
        "calibration of accel_1x: certificate K-4711 of 2025-11-28 has expired, it was valid "
        "until 2026-11-26");
}

TEST_CASE("of several certificates the one counts by which was calibrated last",
          "[bench][station]") {
  const CalibrationRecord expired = certified("20261126T235959Z");
  CalibrationRecord renewed = certified("20271127T235959Z");
  renewed.certificate = "K-4712";
  renewed.calibrated_utc = "20261120T000000Z";
  CHECK(with_calibrations({expired, renewed}).word == "fulfilled");
  CHECK(with_calibrations({renewed, expired}).word == "fulfilled");  // entered in the wrong order
  // A certificate that is entered again puts right what was entered of it before.
  CalibrationRecord mistyped = expired;
  mistyped.valid_until_utc = "20361126T235959Z";
  mistyped.calibrated_utc = "20260201T000000Z";
  CHECK(with_calibrations({mistyped, expired}).word == "expired");
}

TEST_CASE("a rig that goes by another sensitivity than the certificate's is told both",
          "[bench][station]") {
  CHECK(with_calibrations({certified("20271127T235959Z", 0.01021)}).word == "fulfilled");  // 0.1 %
  CHECK(with_calibrations({certified("20271127T235959Z", not_known)}).word == "fulfilled");
  const auto off = with_calibrations({certified("20271127T235959Z", 0.0098)});
  CHECK(off.word == "failed");
  CHECK(off.blocks);
  CHECK_THAT(off.sentence, Contains("states 0.0098 V/(m/s²), the rig goes by 0.0102, +4.1 % off"));
}

TEST_CASE("what is dated later than now is taken for nothing, and the clock is named",
          "[bench][station]") {
  CHECK(with_tests({tested("20261127T120300Z")}).word == "fulfilled");  // clocks differ
  const auto ahead = with_tests({tested("20261128T080000Z")});
  CHECK(ahead.blocks);
  CHECK_THAT(ahead.sentence,
             Contains("yet to come by this computer's clock (2026-11-27 12:00:00)"));
  CalibrationRecord later = certified("20281127T235959Z");
  later.calibrated_utc = "20261201T000000Z";
  const auto dated = with_calibrations({later});
  CHECK(dated.word == "failed");
  CHECK_THAT(dated.sentence, Contains("was calibrated on 2026-12-01, which is yet to come"));
  CalibrationRecord set_back = certified("20271127T235959Z");
  set_back.entered_utc = "20270101T000000Z";
  CHECK_THAT(with_calibrations({set_back}).sentence, Contains("was entered on 2027-01-01"));
}

TEST_CASE("records are kept as files that never change, and read back whole", "[bench][station]") {
  const ScratchFolder root;
  SelfTestRecord record = tested("20261127T080000Z", false);
  record.steps = {{"tap", SelfTestWord::failed, "loose", {}}};
  record.steps[0].readings = {at_least("accel_1x", 0.2, 1, "m/s²"),
                              at_most("accel_1y", not_known, 1, "m/s²")};
  const std::string first = keep_record(root.path(), record);
  record.reason = "the later one";
  const std::string second = keep_record(root.path(), record);  // in the same second
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
  keep_record(root.path(), tested("20261127T080000Z"));
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

TEST_CASE("a self-test counts for what it was judged by", "[bench][station]") {
  StationRecords records;
  records.self_tests = {tested("20261127T080000Z")};
  QualificationSection stricter = asks_for_self_test();
  stricter.self_test->noise_m_s2 = 0.01;
  const auto state = only_state(stricter, records);
  CHECK(state.blocks);
  CHECK_THAT(state.sentence, Contains("judged by other limits than the rig file's"));
  QualificationSection longer = asks_for_self_test();
  longer.self_test->max_age_h = 48;  // no limit of the test
  CHECK_FALSE(only_state(longer, records).blocks);
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
    keep_record(root.path(), tested("20261127T080000Z"));
    const auto lines = read_file(root / ledger_name).value();
    const auto failed = keep_record(root.path(), tested("20261127T090000Z", false));
    write_file(root / ledger_name, lines);
    CHECK_THAT(told(), Contains(failed + " is in no line") && Contains(": test anew"));
    keep_record(root.path(), tested("20261127T100000Z"));
    CHECK(told().empty());
  }
  SECTION("a self-test that failed is not forgotten with its file, nor by one of another rig") {
    const auto told = [&] { return reasons_in(root, asks_for_self_test()); };
    keep_record(root.path(), tested("20261127T080000Z"));
    const auto failed = keep_record(root.path(), tested("20261127T090000Z", false));
    REQUIRE_THAT(told(), Contains("was not passed"));
    std::filesystem::remove(qualification_folder(root.path()) / failed);
    CHECK_THAT(told(), Contains(failed + " is missing"));
    SelfTestRecord simulated = tested("20261127T100000Z");
    simulated.rig_kind = "sim";
    keep_record(root.path(), simulated);
    CHECK_THAT(told(), Contains(failed + " is missing"));
    keep_record(root.path(), tested("20261127T100000Z"));
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

TEST_CASE("all reasons are in one ending, and what is fulfilled is in none", "[bench][station]") {
  QualificationSection section = asks_for_self_test();
  section.calibration = CalibrationDemand{{"accel_1x", "input_torque"}};
  StationEvidence evidence;
  evidence.records.calibrations = {certified("20271127T235959Z")};
  const auto refusal = qualification_of(section, channels, evidence, now).refusal();
  REQUIRE(refusal);
  CHECK(exit_code(*refusal) == 60);
  CHECK_THAT(refusal->reason, Contains("the station is not qualified: self-test: station EOL 3") &&
                                  Contains("; calibration of input_torque: station EOL 3 has no") &&
                                  !Contains("accel_1x"));
  evidence.records.self_tests = {tested(now)};
  section.calibration->channels = {"accel_1x"};
  CHECK_FALSE(qualification_of(section, channels, evidence, now).refusal());
  CHECK_FALSE(Qualification().refusal());
}

}  // namespace rvbench::bench
