#include <catch2/catch.hpp>
#include <set>

#include "bench/qualification/station_records.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "tests/serve/served_station.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/this_build.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::ScratchFolder;
using test::ServedStation;

void write_rig(const ScratchFolder& scratch) {
  bench::write_file(scratch.path() / "rig.json", R"({"rig": "sim", "qualification": {
    "station": "EOL 3", "calibration": {"channels": ["accel_1x"]},
    "golden_unit": {"serial": "G01", "plan": "quick", "baseline_runs": 8}}})");
}

void calibrate(const ScratchFolder& scratch) {
  bench::keep_record(scratch.path() / "runs", {.file = "",
                                               .station = "EOL 3",
                                               .channel = "accel_1x",
                                               .sensitivity = 0.0102,
                                               .certificate = "K-4711",
                                               .by = "J. Weber",
                                               .calibrated_utc = "20200101T000000Z",
                                               .valid_until_utc = "20991231T235959Z",
                                               .entered_utc = bench::utc_now(),
                                               .software = "0.1.0"});
}

nlohmann::json scanned(ServedStation& station, const std::string& serial) {
  const auto reply = station.post("/api/scan", R"({"text":")" + serial + "\"}");
  return nlohmann::json::parse(reply.body, nullptr, false);
}

}  // namespace

TEST_CASE("a station that is not qualified says why, starts nothing, and notices what is mended",
          "[spec][serve][station]") {
  const ScratchFolder scratch;
  write_rig(scratch);
  ServedStation station(scratch, R"("plan": "quick")", "rig.json");
  REQUIRE(station.log_in("otto").status == 200);
  const auto state = scanned(station, "A17");
  CHECK(state.at("station").at("qualified") == false);
  const auto reasons = state.at("station").at("reasons");
  REQUIRE(reasons.size() == 2);
  CHECK_THAT(reasons[0].get<std::string>(), Contains("calibration of accel_1x"));
  CHECK_THAT(reasons[1].get<std::string>(), Contains("golden unit G01: it has no run"));
  CHECK(state.at("next_action") == "station_not_qualified");
  const auto refused = station.post("/api/start");
  CHECK_THAT(refused.body, Contains("not_qualified"));

  // The golden unit itself waits for the calibration alone.
  CHECK(scanned(station, "G01").at("station").at("reasons").size() == 1);
  // What differs from it in case or blanks alone would be tested as a unit like any other.
  for (const char* almost : {"g01", "G 01"}) {
    CHECK(scanned(station, almost) ==
          nlohmann::json({{"error", "almost_golden"}, {"text", almost}}));
  }
  calibrate(scratch);
  CHECK(test::wait_until(
      [&] { return scanned(station, "G01").at("station").at("qualified") == true; }));
  const auto ready = scanned(station, "G01");
  CHECK(ready.at("next_action") == "start");
  CHECK(scanned(station, "A17").at("next_action") == "station_not_qualified");
}

TEST_CASE("points of a plan that was edited since the verdict on show were not measured",
          "[spec][serve][station]") {
  const ScratchFolder scratch;
  write_rig(scratch);
  calibrate(scratch);
  const std::string quick = test::quick_at_top_speed();
  bench::write_file(scratch / "plan.json", quick);
  ServedStation station(scratch, R"("plan": "plan.json")", "rig.json");
  REQUIRE(station.log_in("otto").status == 200);
  const test::Socket events = station.listen();
  const auto statuses = [&] {
    const auto is_whole = [](const std::string& stream) {
      return stream.find("event: heartbeat") < stream.npos;
    };
    const std::string stream = test::received(station.listen(), is_whole);
    std::set<std::string> all;
    const auto snapshot = test::last_event(stream, "snapshot");
    for (const auto& cell : snapshot.at("state").at("matrix").at("cells")) {
      all.insert(cell.at("status"));
    }
    return all;
  };
  using Statuses = std::set<std::string>;
  scanned(station, "G01");
  REQUIRE(station.post("/api/start", R"({"serial":"G01"})").status == 202);
  const auto has_ended = [](const std::string& stream) {
    return stream.find("\"phase\":\"ended\"") < stream.npos;
  };
  (void)test::received(events, has_ended, test::longest_run);
  CHECK(statuses() == Statuses{"done"});
  scanned(station, "g01");  // is refused: the verdict stays on show
  CHECK(statuses() == Statuses{"done"});
  auto edited = nlohmann::ordered_json::parse(quick);
  edited["main"][0]["loads_pct"] = {25, 100};
  bench::write_file(scratch / "plan.json", edited.dump(2));
  scanned(station, "g01");
  CHECK(statuses() == Statuses{"open"});
}

}  // namespace rvbench
