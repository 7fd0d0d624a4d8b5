#include "bench/qualification/qualification_section.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/rig_factory.hpp"
#include "bench/rig_file.hpp"
#include "bench/text_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;

namespace {

std::variant<RigFile, std::vector<hal::ConfigFault>> rig_asking(const std::string& section) {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch.path() / "rig.json";
  write_file(file, R"({"rig": "sim", "qualification": )" + section + "}");
  return read_rig(file.string(), {});
}

std::string faults_of(const std::string& section) {
  const auto rig = rig_asking(section);
  REQUIRE(rig.index() == 1);
  std::string all;
  for (const auto& fault : std::get<1>(rig)) all += hal::describe("rig.json", fault) + "\n";
  return all;
}

}  // namespace

TEST_CASE("what is asked of a station is read with its defaults, and written back the same",
          "[bench][station]") {
  const auto rig = rig_asking(R"({"station": "EOL 3", "self_test": {"noise_m_s2": 0.02},
    "calibration": {"channels": ["accel_4z"]},
    "golden_unit": {"serial": "GOLD", "plan": "quick", "since": "2026-11-02 14:00",
                    "points": [{"speed_rpm": 1210, "load_pct": 50}]}})");
  REQUIRE(rig.index() == 0);
  const QualificationSection* asked = qualification_in(std::get<0>(rig));
  REQUIRE(asked != nullptr);
  CHECK(asked->self_test->noise_m_s2 == 0.02);
  CHECK(asked->self_test->max_age_h == 24);
  CHECK(asked->self_test->tap);
  CHECK(asked->calibration->warn_days == 14);
  CHECK(asked->golden_unit->baseline_runs == 20);
  CHECK(asked->golden_unit->since_utc == "20261102T140000Z");
  CHECK(asked->golden_unit->indicators.at(0).measure == "acceleration_rms");
  const auto written = nlohmann::json::parse(rig_to_json(std::get<0>(rig))).at("qualification");
  const auto again = rig_asking(written.dump());
  REQUIRE(again.index() == 0);
  CHECK(nlohmann::json::parse(rig_to_json(std::get<0>(again))).at("qualification") == written);
}

TEST_CASE("a rig that asks for nothing has no section in any of its texts", "[bench][station]") {
  const auto rig = read_rig("sim", {});
  REQUIRE(rig.index() == 0);
  CHECK(qualification_in(std::get<0>(rig)) == nullptr);
  CHECK_THAT(rig_to_json(std::get<0>(rig)), !Contains("qualification"));
}

TEST_CASE("all faults of a qualification are told at once, with their places", "[bench][station]") {
  CHECK_THAT(faults_of(R"({"station": "EOL 3"})"), Contains("asks for nothing"));
  for (const char* serial : {"GOLDEN ", " ", R"(GOLD\nEN)"}) {
    CHECK_THAT(faults_of(R"({"station": "EOL 3", "golden_unit": {"plan": "quick", "serial": ")" +
                         std::string(serial) + R"("}})"),
               Contains("/qualification/golden_unit/serial: no run can have it"));
  }
  const std::string all = faults_of(R"({"station": "", "self_test": {"speed_rpm": 0, "tapp": true},
    "calibration": {"channels": ["accel_1x", "accel_1x", "accel_7x"]},
    "golden_unit": {"serial": "GOLD", "plan": "quick", "baseline_runs": 3, "since": "spring",
                    "indicators": [{"measure": "kurtosi"}]}})");
  CHECK_THAT(all,
             Contains("/qualification/station: must not be empty") &&
                 Contains("/qualification/self_test/speed_rpm") &&
                 Contains("/qualification/self_test/tapp: unknown key, did you mean \"tap\"") &&
                 Contains("\"accel_1x\" is there twice") && Contains("no channel \"accel_7x\"") &&
                 Contains("/qualification/golden_unit/baseline_runs") &&
                 Contains("golden_unit/since: \"spring\" is no time") &&
                 Contains("did you mean \"kurtosis\"?"));
}

}  // namespace rvbench::bench
