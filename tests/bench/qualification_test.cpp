#include "bench/qualification/qualification.hpp"

#include <catch2/catch.hpp>

#include "tests/bench/station_on_record.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using test::asks_for_calibration;
using test::asks_for_self_test;
using test::certified;
using test::channels;
using test::now;
using test::tested;

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
