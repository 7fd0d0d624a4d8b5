#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "hal/formats/read_recordings.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/small_machine.hpp"
#include "tests/support/scratch_folder.hpp"

// Ways of finding what paths contribute, where a hammer test is not all there is.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using nlohmann::json;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::SmallMachine;

CommandAnswer tpa(const SmallMachine& machine, const json& project) {
  const ScratchFolder scratch;
  return test::rvbench(
      {"tpa", test::write_small_machine(scratch.path(), machine, project), "--json"});
}

json told(const SmallMachine& machine, const json& project) {
  const CommandAnswer answer = tpa(machine, project);
  INFO(answer.err << answer.out.substr(0, 2000));
  REQUIRE(answer.code == 0);
  return json::parse(answer.out);
}

const json& first_answer(const json& study) {
  return study.at("motions").at(0).at("answers").at(0);
}

std::vector<std::string> fault_kinds(const json& study) {
  std::vector<std::string> kinds;
  for (const json& fault : study.at("motions").at(0).at("faults"))
    kinds.push_back(fault.at("kind"));
  return kinds;
}

json operational_project(const std::vector<std::string>& references) {
  json project = test::small_project();
  for (const char* key : {"hammer", "paths"}) project.erase(key);
  project["method"] = "operational";
  project["step_Hz"] = 5;
  project["sensors"].erase("validation");
  project["sensors"]["indicators"]["points"] = references;
  return project;
}

json blocked_project() {
  json project = test::small_project();
  project["method"] = "blocked_forces";
  project["source"] = {"motor"};
  for (const char* point : {"base", "plate"}) {
    project["sensors"]["indicators"]["points"].push_back(point);
  }
  return project;
}

json mounts_project() {
  json project = test::small_project();
  project["method"] = "parametric_mounts";
  project["paths"]["points"] = {"J1 passive", "J2 passive"};
  project["active"] = {{"points", {"J1 active", "J2 active"}}, {"directions", {"+X"}}};
  project["sensors"]["indicators"]["points"] = {"base"};
  project["hammer"]["hits"][0]["point"] = "J1 passive";
  project["hammer"]["hits"][1]["point"] = "J2 passive";
  project["bands"][0]["to_Hz"] = 100;
  return project;
}

}  // namespace

TEST_CASE("without a hammer, operation tells which reference hands on most", "[bench][tpa]") {
  const json study =
      told({.force_1 = 3, .force_2 = 1}, operational_project({"J1 active", "J2 active"}));
  const json& answer = first_answer(study);
  CHECK(answer.at("word") == "leads");
  CHECK(answer.at("leader") == "J1 +X");
  CHECK(answer.at("validation_score").get<double>() > 0.99);
  // flange = 0.5·F1 + 0.5·F2 = t·(F1 + 0.2·F2) + t·(0.2·F1 + F2), so t = 0.5/1.2; white over 480
  // of 1000 Hz, and the scatter of that over 10 s is 1 %.
  const double expected = 0.5 / 1.2 * std::sqrt(9 + 0.04) * std::sqrt(480. / 1000);
  CHECK(answer.at("paths").at(0).at("rms").get<double>() == Approx(expected).epsilon(0.05));
  CHECK(fault_kinds(study).empty());
  CHECK(study.at("frfs").at("hits") == 0);

  const json other =
      told({.force_1 = 1, .force_2 = 3}, operational_project({"J1 active", "J2 active"}));
  CHECK(first_answer(other).at("leader") == "J2 +X");
}

TEST_CASE("references that moved together name nobody", "[bench][tpa]") {
  // Both sensors of J1 hear nearly the same: it is all of one force.
  json project = operational_project({"J1 active", "J1 passive"});
  project["sensors"]["targets"]["points"] = {"flange"};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const json study = told({.force_1 = 3, .force_2 = 0, .seed = seed}, project);
    CAPTURE(seed);
    CHECK(first_answer(study).at("leader").is_null());
    CHECK(first_answer(study).at("word") == "not_told_apart");
    CHECK(fault_kinds(study) == std::vector<std::string>{"references_together"});
  }
}

TEST_CASE("references that do not drive the target name nobody", "[bench][tpa][null]") {
  json project = operational_project({"J1 active", "J2 active"});
  project["sensors"]["targets"]["points"] = {"forearm"};
  const json study = told({.forearm_noise = 20}, project);
  CHECK(first_answer(study).at("word") == "not_validated");
  CHECK(fault_kinds(study) == std::vector<std::string>{"not_validated"});
}

TEST_CASE("operation that is too short to learn from is refused, and says what would do",
          "[bench][tpa]") {
  json project = operational_project({"J1 active", "J2 active"});
  project["step_Hz"] = 0.5;  // nine blocks of 2 s
  project["sensors"]["indicators"]["points"].push_back("J1 passive");
  project["sensors"]["indicators"]["points"].push_back("J2 passive");
  const CommandAnswer answer = tpa({}, project);
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("slow.h5") && Contains("4 references") && Contains("8 at least"));
}

TEST_CASE("blocked forces are ranked, and both halves of the indicators agree", "[bench][tpa]") {
  const json study = told({.force_1 = 3, .force_2 = 1}, blocked_project());
  CHECK(first_answer(study).at("leader") == "J1 +X");
  CHECK(study.at("motions").at(0).at("halves_disagree_by").get<double>() < 0.01);
  CHECK(fault_kinds(study).empty());
}

TEST_CASE("halves of the indicators that disagree are told", "[bench][tpa]") {
  // J2 active is in one half, and the other knows nothing of its sign.
  const json study = told({.sign_of_j2 = -1}, blocked_project());
  const auto kinds = fault_kinds(study);
  CHECK(std::ranges::find(kinds, "halves_disagree") != kinds.end());
}

TEST_CASE("mounts are known by their stiffness, and what they pass on is ranked", "[bench][tpa]") {
  SmallMachine machine{.force_1 = 3, .force_2 = 1};
  machine.mount_stiffness_N_m = 2e4;
  const json study = told(machine, mounts_project());
  const json& motion = study.at("motions").at(0);
  REQUIRE(motion.at("mounts").size() == 2);
  for (const json& mount : motion.at("mounts")) {
    // Second differences at 2000 Hz fall short of -ω² by 0.8 % at 100 Hz.
    CHECK(mount.at("found").at("stiffness_N_m").get<double>() == Approx(2e4).epsilon(0.02));
  }
  CHECK(motion.at("mounts_score").get<double>() > 0.95);
  CHECK(first_answer(study).at("leader") == "J1 +X");
  CHECK(first_answer(study).at("validation_score").get<double>() > 0.95);
}

TEST_CASE("mounts that something else pushes past are not believed", "[bench][tpa]") {
  SmallMachine machine{.force_1 = 3, .force_2 = 1};
  machine.mount_stiffness_N_m = 2e4;
  machine.forearm_noise = 5;
  CHECK(first_answer(told(machine, mounts_project())).at("word") == "not_validated");
}

TEST_CASE("a path that was hit once does not lead: nobody knows how far that hit was off",
          "[bench][tpa]") {
  SmallMachine machine{.force_1 = 3, .force_2 = 1};
  machine.hits = 1;
  const json study = told(machine, test::small_project());
  CHECK(first_answer(study).at("leader").is_null());
  CHECK(first_answer(study).at("word") == "not_sure");
  const auto kinds = fault_kinds(study);
  CHECK(std::ranges::count(kinds, "frf_errors_unknown") == 2);
}

TEST_CASE("bands between lines, and hits in other units or another sense, are no internal error",
          "[bench][tpa]") {
  json project = test::small_project();
  project["bands"][0] = {{"from_Hz", 20.3}, {"to_Hz", 20.9}};  // lines are 2 Hz apart
  const CommandAnswer between = tpa({}, project);
  CHECK(between.code == 20);
  CHECK_THAT(between.err, Contains("20.3 to 20.9 Hz"));
}

TEST_CASE("histories that cannot be made are refused before anything is written", "[bench][tpa]") {
  const ScratchFolder scratch;
  json project = test::small_project();
  project["bands"][0] = {{"from_Hz", 20}, {"to_Hz", 30}};  // six lines
  const std::string file = test::write_small_machine(scratch.path(), {}, project);
  const std::string out = (scratch / "out").string();
  const CommandAnswer refused = test::rvbench({"tpa", file, "--out", out, "--histories"});
  CHECK(refused.code == 20);
  CHECK_THAT(refused.err, Contains("eight lines"));
  CHECK_FALSE(std::filesystem::exists(out + "/tpa.json"));
  CHECK(test::rvbench({"tpa", file, "--out", out}).code == 0);
}

TEST_CASE("histories are written beside the answer, a channel per force and contribution",
          "[bench][tpa]") {
  const ScratchFolder scratch;
  const std::string file = test::write_small_machine(scratch.path(), {});
  const std::string out = (scratch / "out").string();
  CHECK(test::rvbench({"tpa", file, "--histories"}).code == 2);
  REQUIRE(test::rvbench({"tpa", file, "--out", out, "--histories"}).code == 0);
  const auto read = hal::read_recordings(out + "/histories/motion_1.h5");
  REQUIRE(read);
  const Recording& motion = read.value().front();
  REQUIRE(motion.channels.size() == 4);
  CHECK(motion.channels[0].info.name == "force at J1 active");
  CHECK(motion.channels[0].info.unit == "N");
  CHECK(motion.channels[2].info.name == "flange by J1 active +X");
  CHECK(motion.channels[2].info.unit == "m/s²");
  // White force of 3 N over 480 of 1000 Hz, away from both ends and less the band's faded edges.
  const Eigen::VectorXd force = motion.channels[0].samples.segment(4000, 12000);
  CHECK(std::sqrt(force.squaredNorm() / double(force.size())) ==
        Approx(3 * std::sqrt(460. / 1000)).epsilon(0.06));
}

TEST_CASE("keys of one method are those of no other", "[bench][tpa]") {
  const auto faults_of = [](const json& project) {
    const ScratchFolder scratch;
    return test::rvbench({"check", test::write_small_machine(scratch.path(), {}, project)});
  };
  CHECK(faults_of(operational_project({"J1 active"})).code == 0);
  CHECK(faults_of(blocked_project()).code == 0);
  CHECK(faults_of(mounts_project()).code == 0);
  json operational = operational_project({"J1 active"});
  operational["frfs"] = {"J1.h5"};
  operational["rule"] = "truncation_by_noise";
  operational["sensors"]["validation"] = operational["sensors"]["targets"];
  const CommandAnswer without = faults_of(operational);
  CHECK(without.code == 3);
  CHECK_THAT(without.err, Contains("/frfs: operation alone has no FRFs") &&
                              Contains("/rule: truncation_by_noise needs FRFs") &&
                              Contains("/sensors/validation: operational is validated by blocks"));
  json blocked = blocked_project();
  blocked["source"] = {"forearm"};
  CHECK_THAT(faults_of(blocked).err, Contains("forearm +X is a sensor"));
  json mounts = mounts_project();
  mounts["active"]["points"] = {"J1 active"};
  mounts["rule"] = "none";
  const CommandAnswer one_side = faults_of(mounts);
  CHECK_THAT(one_side.err, Contains("1 places on the active side, for 2 paths") &&
                               Contains("/rule: mounts are fitted"));
  json stray = test::small_project();
  stray["source"] = {"motor"};
  CHECK_THAT(faults_of(stray).err, Contains("/source: unknown key"));
  json unknown = test::small_project();
  unknown["method"] = "operation";
  CHECK_THAT(faults_of(unknown).err, Contains("operational"));
}

}  // namespace rvbench::bench
