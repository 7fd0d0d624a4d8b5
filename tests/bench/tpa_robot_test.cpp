#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/text_file.hpp"
#include "bench/tpa_simulation.hpp"
#include "bench/tpa_text.hpp"
#include "sim/robot/operation.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

// From files of a virtual robot, which do not know who shakes it, to who does.
namespace rvbench::bench {
namespace {

using rvbench::test::ScratchFolder;

const SimulatedSession small{.seed = 1, .record_s = 10, .hits = 3, .with_reducer = false};

void simulate(const std::filesystem::path& folder) {
  std::ostringstream nowhere;
  Console console{nowhere, nowhere};
  ProgressBar bar(console, ProgressBar::Style::silent);
  REQUIRE(write_virtual_robot(folder, small, bar, {}));
}

// Who leads at X, Y, Z, as only the simulation knows.
std::array<Eigen::Index, 3> true_leaders(sim::RobotMotion motion) {
  return sim::card_of(motion).leaders;
}

}  // namespace

TEST_CASE("the files of a virtual robot are those of a test, and do not tell its truth",
          "[bench][tpa][robot]") {
  if (rvbench::test::too_long_under_sanitizer()) return;
  const ScratchFolder scratch;
  simulate(scratch.path());
  std::set<std::string> kinds;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch.path())) {
    if (!entry.is_regular_file()) continue;
    ++files;
    kinds.insert(entry.path().extension().string());
  }
  CHECK(files == 18 + 3 + 3 + 1);  // hits, motions before and after, project
  CHECK(kinds == std::set<std::string>{".h5", ".json"});
  const std::string project = (scratch / "project.json").string();
  CHECK(test::rvbench({"check", project}).code == 0);
  const std::string text = read_file(project).value_or("");
  for (const char* word : {"leader", "fault", "input_shaft", "preset"}) {
    CHECK((text.find(word) == std::string::npos));
  }

  SECTION("whoever is said to lead, leads") {
    const test::Answer answer = test::rvbench({"tpa", project, "--json"});
    INFO(answer.err);
    REQUIRE(answer.code == 0);
    const auto json = nlohmann::json::parse(answer.out);
    const sim::VirtualRobot robot({});  // its places alone
    REQUIRE(json.at("motions").size() == 3);
    for (std::size_t m = 0; m < 3; ++m) {
      const auto& motion = json.at("motions").at(m);
      CHECK(motion.at("name") == sim::card_of(sim::robot_motions[m]).name);
      CHECK(motion.at("validation_score").is_number());
      CHECK(motion.at("reducer").is_null());
      CHECK(motion.at("repair").at("changes").size() == 3);
      for (std::size_t target = 0; target < 3; ++target) {
        const auto& found = motion.at("answers").at(target);
        CAPTURE(m, target, found.at("sentence").get<std::string>());
        if (found.at("leader").is_null()) continue;
        const Eigen::Index leader = true_leaders(sim::robot_motions[m])[target];
        CHECK(found.at("leader") == path_name(leader, robot.path_places()));
      }
    }
  }
}

}  // namespace rvbench::bench
