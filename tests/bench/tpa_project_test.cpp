#include "bench/tpa_project.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/bench/answers.hpp"
#include "tests/bench/small_machine.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

// Faults of a project whose files are all there, unless it names others.
std::vector<hal::ConfigFault> faults_of(const nlohmann::json& project) {
  const ScratchFolder scratch;
  for (const char* name : {"J1.h5", "J2.h5", "slow.h5"}) write_file(scratch / name, "");
  write_file(scratch / "project.json", project.dump(1));
  auto read = read_tpa_project((scratch / "project.json").string());
  return read.index() == 1 ? std::get<1>(std::move(read)) : std::vector<hal::ConfigFault>{};
}

std::string message_at(const std::vector<hal::ConfigFault>& faults, const std::string& pointer) {
  const auto found = std::ranges::find(faults, pointer, &hal::ConfigFault::pointer);
  return found == faults.end() ? "" : found->message;
}

}  // namespace

TEST_CASE("a project file says where hits and motions are, seen from itself", "[bench][tpa]") {
  const ScratchFolder scratch;
  const std::string file = test::write_small_machine(scratch.path(), {});
  const auto read = read_tpa_project(file);
  REQUIRE(read.index() == 0);
  const TpaProject& project = std::get<0>(read);
  CHECK(project.name == "small machine");
  REQUIRE(project.hammer);
  CHECK(project.hammer->hits.at(1).file == (scratch / "J2.h5").string());
  CHECK(project.hammer->hits.at(1).place == DegreeOfFreedom{"J2 active", "+X"});
  CHECK(project.paths.size() == 2);
  CHECK(project.indicators.size() == 4);
  CHECK(project.bands.at(0).last_Hz == 500);
  CHECK(project.resampling.replicates == 40);
  CHECK(project.motions.at(0).recording == (scratch / "slow.h5").string());
  CHECK_FALSE(project.motions.at(0).reducer);
  CHECK(analysis::find_rule(project.rule) != nullptr);
}

TEST_CASE("all that is wrong with a project is told at once, each with its place", "[bench][tpa]") {
  nlohmann::json project = test::small_project();
  project["rule"] = "truncation_by_luck";
  project["bands"][0]["to_Hz"] = 10;
  project["motions"][0]["recording"] = "fast.h5";
  project["motions"][0]["reducer"] = {
      {"joint", "J9"}, {"recording", "slow.h5"}, {"kinematics", "rv20f"}};
  project["hammer"]["hits"][1]["point"] = "J3 active";
  project["sensors"]["indicators"]["points"].push_back("flange");
  project["colour"] = "red";
  const auto faults = faults_of(project);
  CHECK_THAT(message_at(faults, "/rule"), Contains("truncation_by_l_curve"));
  CHECK_THAT(message_at(faults, "/bands/0/to_Hz"), Contains("above from_Hz"));
  CHECK_THAT(message_at(faults, "/motions/0/recording"), Contains("there is no file"));
  CHECK_THAT(message_at(faults, "/motions/0/reducer/joint"), Contains("J9"));
  CHECK_THAT(message_at(faults, "/motions/0/reducer/kinematics"), Contains("rv20f"));
  CHECK_THAT(message_at(faults, "/hammer/hits/1/point"), Contains("none of the paths"));
  CHECK_THAT(message_at(faults, "/hammer/hits"), Contains("no hit at the path J2 active +X"));
  CHECK_THAT(message_at(faults, "/sensors/indicators"), Contains("flange +X is a target as well"));
  CHECK_THAT(message_at(faults, "/colour"), Contains("unknown key"));
  for (const hal::ConfigFault& fault : faults) CHECK(fault.line > 0);
}

TEST_CASE("a project has ready FRFs or hits, sensors enough, and each place once", "[bench][tpa]") {
  nlohmann::json project = test::small_project();
  CHECK(faults_of(project).empty());
  SECTION("both") {
    project["frfs"] = {"J1.h5"};
    CHECK_THAT(message_at(faults_of(project), ""), Contains("one of them and one only"));
  }
  SECTION("neither") {
    project.erase("hammer");
    CHECK_THAT(message_at(faults_of(project), ""), Contains("one of them and one only"));
  }
  SECTION("fewer indicators than paths") {
    project["sensors"]["indicators"]["points"] = {"J1 passive"};
    CHECK_THAT(message_at(faults_of(project), "/sensors/indicators"),
               Contains("1 indicators cannot tell the forces at 2 paths"));
  }
  SECTION("a place twice, by two names of its direction") {
    project["sensors"]["targets"]["directions"] = {"+X", "-X"};
    CHECK_THAT(message_at(faults_of(project), "/sensors/targets"), Contains("is there twice"));
  }
  SECTION("no sensor to validate by") {
    project["sensors"].erase("validation");
    CHECK_FALSE(faults_of(project).empty());
  }
}

TEST_CASE("check knows a project of paths, and other kinds are told from it", "[bench][tpa]") {
  const ScratchFolder scratch;
  const std::string file = test::write_small_machine(scratch.path(), {});
  const test::CommandAnswer sound = test::rvbench({"check", file});
  CHECK(sound.code == 0);
  CHECK_THAT(sound.out, Contains("tpa, no fault"));
  nlohmann::json project = test::small_project();
  project["motions"] = nlohmann::json::array();
  write_file(file, project.dump());
  CHECK(test::rvbench({"check", file}).code == 3);
  write_file(scratch / "rig.json", R"({"rig": "sim"})");
  const test::CommandAnswer other = test::rvbench({"tpa", (scratch / "rig.json").string()});
  CHECK(other.code == 3);
  CHECK_THAT(other.err, Contains("seems to be a rig file"));
}

}  // namespace rvbench::bench
