#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>

#include "bench/campaign_points.hpp"
#include "bench/campaign_source.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

void write_ramp(const std::string& path, int rows) {
  std::ofstream file(path);
  file << "x,force\n";
  for (int row = 0; row < rows; ++row) file << row << ',' << 2 * row << '\n';
}

Campaign read(const test::ScratchFolder& scratch, const std::string& text) {
  std::ofstream(scratch / "c.json") << text;
  const auto made = read_campaign(scratch / "c.json");
  if (const auto* refusal = std::get_if<1>(&made)) FAIL(refusal->faults.front().message);
  return std::get<Campaign>(made);
}

Refusal refusal_of(const test::ScratchFolder& scratch, const std::string& text) {
  std::ofstream(scratch / "c.json") << text;
  const auto made = read_campaign(scratch / "c.json");
  REQUIRE(made.index() == 1);
  return std::get<1>(made);
}

// A point of a run: a vibration of 20 samples, and torque on a slower clock of its own.
Recording point(double speed_rpm, double load_pct, int repeat) {
  Recording made;
  made.planned_speed_rpm = speed_rpm;
  made.load_pct = load_pct;
  made.repeat = repeat;
  made.status = "ok";
  made.channels = {{{"accel_1x", "m/s²", "+X", not_known}, 4960, 0, Eigen::VectorXd::Ones(20)},
                   {{"input_torque", "N·m", "", not_known}, 496, 0, Eigen::VectorXd::Ones(2)}};
  return made;
}

}  // namespace

TEST_CASE("points of a run are records under the conditions of its plan", "[bench][explain]") {
  Campaign campaign;
  for (const int repeat : {1, 2}) add_point(campaign, point(605, 50, repeat));
  add_point(campaign, point(1210, 50, 1));
  REQUIRE(campaign.records.size() == 3);
  const CampaignRecord& second = campaign.records[1];
  CHECK(second.name == "605 rpm, 50 %, repeat 2");
  CHECK(second.condition == campaign.records[0].condition);
  CHECK(second.programme == campaign.records[0].programme);
  CHECK(second.speed == "605 rpm");
  CHECK(second.load == "50 %");
  CHECK(second.learned_from);
  CHECK(campaign.records[2].condition != second.condition);
  CHECK(campaign.records[2].load == second.load);
  CHECK(campaign.notes.empty());

  Recording unsettled = point(1815, 50, 1);
  unsettled.status = "unsettled";
  add_point(campaign, unsettled);
  CHECK(campaign.records.size() == 3);
  REQUIRE(campaign.notes.size() == 1);
  CHECK(campaign.notes[0] == "1815 rpm, 50 %, repeat 1 is left out: unsettled");
  CHECK_FALSE(is_point(Recording{}));
}

TEST_CASE("of several clocks, that of the channels which count is kept", "[bench][explain]") {
  Recording torque = point(605, 50, 1);
  CHECK(keep_one_clock(torque, {"supply", "input_torque"}).empty());
  REQUIRE(torque.channels.size() == 1);
  CHECK(torque.channels[0].info.name == "input_torque");
  Recording first = point(605, 50, 1);
  CHECK(keep_one_clock(first, {"input_torque", "accel_1x"}).empty());  // of two, the first
  CHECK(first.channels.at(0).info.name == "input_torque");
  Recording vibration = point(605, 50, 1);
  CHECK(keep_one_clock(vibration, {"way"}).empty());  // none of these is there
  REQUIRE(vibration.channels.size() == 1);
  CHECK(vibration.channels[0].info.name == "accel_1x");
}

TEST_CASE("a campaign cuts its recordings into stretches", "[bench][explain]") {
  const test::ScratchFolder scratch;
  write_ramp(scratch / "ramp.csv", 10000);
  const Campaign campaign = read(scratch, R"({"campaign": "ramp", "files": [
    {"file": "ramp.csv", "rate_Hz": 1000, "records": [
      {"from_s": 2, "to_s": 4, "condition": "slow", "programme": "p"},
      {"from_s": 0, "to_s": 1, "condition": "fast", "speed": "605", "use": "predict"}]}]})");
  REQUIRE(campaign.records.size() == 2);
  const CampaignRecord& slow = campaign.records[0];
  CHECK(slow.condition == "slow");
  CHECK(slow.programme == "p");
  CHECK(slow.learned_from);
  CHECK(slow.lead_in == 1000);  // the model comes into step on the second before
  CHECK(slow.recording.find("x")->samples.size() == 3000);
  CHECK(slow.recording.find("x")->samples[slow.lead_in] == 2000);
  CHECK(slow.recording.find("force")->samples[slow.lead_in] == 4000);
  CHECK(campaign.records[1].lead_in == 0);
  CHECK(campaign.records[1].speed == "605");
  CHECK_FALSE(campaign.records[1].learned_from);
  REQUIRE(campaign.hashes.size() == 1);
  CHECK(campaign.hashes[0].second.size() == 64);
}

TEST_CASE("a recording alone is left out by quarters", "[bench][explain]") {
  const test::ScratchFolder scratch;
  write_ramp(scratch / "ramp.csv", 8000);
  const auto made = campaign_of({scratch / "ramp.csv"}, 1000);
  REQUIRE(made.index() == 0);
  const Campaign& campaign = std::get<Campaign>(made);
  REQUIRE(campaign.records.size() == 4);
  CHECK(campaign.records[3].condition != campaign.records[2].condition);
  CHECK(campaign.records[3].recording.find("x")->samples[campaign.records[3].lead_in] == 6000);
}

TEST_CASE("files of one name, and repeats of one condition, stay apart", "[bench][explain]") {
  const test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "monday");
  std::filesystem::create_directories(scratch / "tuesday");
  write_ramp(scratch / "monday/run.csv", 5000);
  write_ramp(scratch / "tuesday/run.csv", 6000);
  const auto made = campaign_of({scratch / "monday/run.csv", scratch / "tuesday/run.csv"}, 1000);
  REQUIRE(made.index() == 0);
  const auto& days = std::get<Campaign>(made).records;
  REQUIRE(days.size() == 2);
  CHECK(days[0].name != days[1].name);
  CHECK(days[0].condition != days[1].condition);

  const Campaign repeats = read(scratch, R"({"campaign": "r", "files": [
    {"file": "monday/run.csv", "rate_Hz": 1000, "records": [
      {"from_s": 0, "to_s": 2, "condition": "slow"},
      {"from_s": 2, "to_s": 4, "condition": "slow"}]}]})");
  CHECK(repeats.records[0].name != repeats.records[1].name);
  CHECK(repeats.records[0].condition == repeats.records[1].condition);
}

TEST_CASE("columns without names get theirs from the campaign", "[bench][explain]") {
  const test::ScratchFolder scratch;
  std::ofstream file(scratch / "bare.csv");
  for (int row = 0; row < 4000; ++row) file << 10 + 0.001 * row << ',' << row << '\n';
  file.close();
  const Campaign campaign = read(scratch, R"({"campaign": "bare", "files": [
    {"file": "bare.csv", "columns": ["t", "way"], "time_column": "t"}]})");
  REQUIRE(campaign.records.size() == 4);
  REQUIRE(campaign.records[0].recording.channels.size() == 1);
  CHECK(campaign.records[0].recording.channels[0].rate_Hz == Approx(1000));
  CHECK(campaign.notes.empty());
}

TEST_CASE("a column time_s says the rate where nobody else does", "[bench][explain]") {
  const test::ScratchFolder scratch;
  std::ofstream(scratch / "own.csv") << "time_s,way\n0,1\n0.01,2\n0.02,3\n0.03,4\n";
  const auto read = [&](double rate_Hz) {
    return std::get<Campaign>(campaign_of({scratch / "own.csv"}, rate_Hz)).records[0].recording;
  };
  const Recording stamped = read(not_known);
  REQUIRE(stamped.channels.size() == 1);
  CHECK(stamped.channels[0].rate_Hz == Approx(100));
  CHECK(read(50).find("way")->rate_Hz == 50);
  AND_THEN("a note says where the two differ") {
    const auto notes = [&](double rate_Hz) {
      return std::get<Campaign>(campaign_of({scratch / "own.csv"}, rate_Hz)).notes;
    };
    CHECK(notes(100).empty());
    REQUIRE(notes(50).size() == 1);
    CHECK_THAT(notes(50)[0], Contains("taken at 50 Hz as stated") && Contains("says 100 Hz"));
  }
}

TEST_CASE("rows that miss in time_s are missed also where a rate is stated", "[bench][explain]") {
  const test::ScratchFolder scratch;
  const auto lost = [&](int count) {
    std::ofstream file(scratch / "own.csv");
    file << "time_s,way\n";
    for (int row = 0; row < 4000; ++row) {
      if (row < 2000 || row >= 2000 + count) file << 0.01 * row << ',' << row << '\n';
    }
    file.close();
    return campaign_of({scratch / "own.csv"}, 100);
  };
  const auto whole = lost(0);
  CHECK(std::get<Campaign>(whole).notes.empty());
  const auto few = lost(5);
  REQUIRE(std::get<Campaign>(few).notes.size() == 1);
  CHECK_THAT(std::get<Campaign>(few).notes[0], Contains("time stamps are not uniform"));
  for (const CampaignRecord& record : std::get<Campaign>(few).records) {
    const Eigen::VectorXd& way = record.recording.find("way")->samples;
    const Eigen::VectorXd steps = way.tail(way.size() - 1) - way.head(way.size() - 1);
    CHECK((steps.array() - 1).abs().maxCoeff() < 1e-6);
  }
  const auto many = lost(20);
  REQUIRE(many.index() == 1);
  CHECK_THAT(std::get<1>(many).faults.at(0).message, Contains("a gap of 0.21 s after 19.99 s"));
}

TEST_CASE("what a campaign does not say right is told with its place", "[bench][explain]") {
  const test::ScratchFolder scratch;
  write_ramp(scratch / "ramp.csv", 100);
  const auto [wrong, of_recordings] = refusal_of(scratch, R"({"campaign": "x", "files": [
    {"file": "ramp.csv", "rate_Hz": -1, "records": [{"from_s": 0, "to_s": 1, "use": "guess"}]}],
    "speed": 3})");
  CHECK_FALSE(of_recordings);
  REQUIRE(wrong.size() == 3);
  CHECK(wrong[0].pointer == "/files/0/rate_Hz");
  CHECK(wrong[1].pointer == "/files/0/records/0/use");
  CHECK(wrong[2].pointer == "/speed");

  const auto message = [&](const std::string& file) {
    const auto refusal = refusal_of(scratch, R"({"campaign": "x", "files": [)" + file + "]}");
    CHECK(refusal.of_recordings);
    return refusal.faults.front().message;
  };
  CHECK_THAT(message(R"({"file": "absent.csv"})"), Contains("absent.csv"));
  CHECK_THAT(message(R"({"file": "ramp.csv"})"), Contains("states no sample rate"));
  CHECK_THAT(message(R"({"file": "ramp.csv", "rate_Hz": 10, "columns": ["a"]})"),
             Contains("1 columns are named, the file has 2"));
  CHECK_THAT(message(R"({"file": "ramp.csv", "time_column": "t"})"),
             Contains("there is no column \"t\""));
  CHECK_THAT(message(R"({"file": "ramp.csv", "rate_Hz": 10, "records": [
               {"to_s": 6, "condition": "a"}, {"to_s": 6, "condition": "b"}]})"),
             Contains("share samples"));
  CHECK_THAT(message(R"({"file": "ramp.csv", "rate_Hz": 10, "records": [{"to_s": 11}]})"),
             Contains("0 to 11 s is no stretch of a recording of 10 s"));
  CHECK_THAT(
      message(R"({"file": "ramp.csv", "rate_Hz": 10}, {"file": "./ramp.csv", "rate_Hz": 10})"),
      Contains("the same recording as"));
}

}  // namespace rvbench::bench
