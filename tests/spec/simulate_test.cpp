#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>

#include "bench/simulated_recording.hpp"
#include "bench/text_file.hpp"
#include "hal/formats/read_recordings.hpp"
#include "hal/types/units.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::ScratchFolder;

// Two points of a run, as short as may be: what simulate looks at is what they were planned to be.
void write_run(const std::filesystem::path& file) {
  std::vector<Recording> points(2);
  for (int i = 0; i < 2; ++i) {
    Recording& point = points[static_cast<std::size_t>(i)];
    point.planned_speed_rpm = 1210;
    point.load_pct = 50 + 50 * i;
    for (const char* name : {"input_torque", "input_angle"}) {
      point.channels.push_back({{name, "", "", not_known}, 496, 0, Eigen::VectorXd::Zero(64)});
    }
  }
  REQUIRE(bench::write_hdf5(file, points));
}

}  // namespace

TEST_CASE("simulate shows what the shipped bench makes of a run's points", "[spec][simulate]") {
  const ScratchFolder scratch;
  write_run(scratch / "recording.h5");
  const std::vector<std::string> command{"simulate", "--plant",      "rv20e_bench",
                                         "--like",   "recording.h5", "--out"};
  const auto into = [&](const std::string& out) {
    std::vector<std::string> words = command;
    words.push_back(out);
    return test::rvbench(scratch.path(), words);
  };
  const Answer answer = into("sim.h5");
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  CHECK_THAT(answer.out, Contains("sim.h5: 128 samples of 2 points at 496 Hz"));
  const auto simulated = hal::read_recordings(scratch / "sim.h5");
  REQUIRE(simulated);
  const auto& points = simulated.value();
  // Between 50 and 100 % of 167 N·m lie 83.5 N·m at the brake, 1/121 of it at the input.
  CHECK(points[1].torque_Nm - points[0].torque_Nm == Approx(83.5 / 121).epsilon(0.02));

  const Answer again = into("sim.h5");
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("sim.h5"));
  const Answer csv = into("sim.csv");
  CHECK(csv.code == 20);
  CHECK_THAT(csv.err, Contains("holds 2 recordings"));
}

TEST_CASE("simulate runs a plant along a plan, before anything is measured", "[spec][simulate]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder scratch;
  const auto along = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"simulate", "--plan", "quick", "--out", "sim.h5", "--plant"});
    return test::rvbench(scratch.path(), words);
  };
  const Answer answer = along({"rv20e_bench", "--rate", "200"});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  CHECK_THAT(answer.err, Contains("simulate") && Contains("100 %"));
  const auto simulated = hal::read_recordings(scratch / "sim.h5");
  REQUIRE(simulated);
  REQUIRE(simulated.value().size() == 4);  // as `rvbench run quick --dry-run` has them
  for (const Recording& point : simulated.value()) {
    // The motor slips by 2 to 3 % at rated load: the article.
    CHECK(point.speed_rpm < point.planned_speed_rpm);
    CHECK(point.speed_rpm > 0.95 * point.planned_speed_rpm);
    const Eigen::VectorXd& angle_rad = point.find("input_angle")->samples;
    const double output_turns =
        (angle_rad[angle_rad.size() - 1] - angle_rad[0]) / units::two_pi / 121;
    CHECK(output_turns > 4);  // as the plan wants it: what explain compares by
    CHECK(output_turns < 4.5);
  }
  const Answer other = along({"emps"});
  CHECK(other.code == 3);
  CHECK_THAT(other.err, Contains("emps: /inputs: ") && Contains("supply"));
  CHECK(along({"rv20e_bench", "--like", "sim.h5"}).code == 2);
  CHECK(along({"rv20e_bench", "--rate", "1e300"}).code == 2);
  const Answer many = along({"rv20e_bench", "--rate", "1e7"});
  CHECK(many.code == 2);
  CHECK_THAT(many.err, Contains("too many"));
  const Answer unknown = along({"rv20e_bnch"});
  CHECK(unknown.code == 3);
  CHECK_THAT(unknown.err, Contains("did you mean \"rv20e_bench\""));
}

TEST_CASE("an interrupted simulate ends ABORTED, and writes nothing", "[spec][simulate]") {
  const ScratchFolder scratch;
  test::Program program(scratch.path(), {test::rvbench_path(), "simulate", "--plant", "rv20e_bench",
                                         "--plan", "quick", "--rate", "100", "--out", "sim.h5"});
  REQUIRE(program.says("simulate"));
  REQUIRE(program.send(SIGINT));
  const Answer answer = program.wait();
  CHECK(answer.code == 50);
  CHECK_THAT(answer.err, Contains("nothing was written"));
  CHECK_FALSE(std::filesystem::exists(scratch / "sim.h5"));
}

TEST_CASE("a run on a plant that is none ends with the pointer", "[spec][simulate]") {
  const ScratchFolder scratch;
  bench::write_file(scratch / "plant.json", R"({"plant": "stub",
    "bodies": [{"name": "motor", "motion": "rotation", "inertia": {"value": -1, "unit": "kg·m²"}}],
    "outputs": [{"channel": "x", "unit": "rad", "is": "position", "body": "motor"}]})");
  bench::write_file(scratch / "rig.json", R"({"rig": "sim", "plant": "plant.json"})");
  const Answer answer = test::rvbench(
      scratch.path(), {"run", "quick", "--rig", "rig.json", "--serial", "A1", "--out", "runs"});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err,
             Contains("/plant: plant.json:2: /bodies/0/inertia/value: -1 must be above 0"));
  CHECK(test::rvbench(scratch.path(), {"check", "rig.json"}).code == 3);
}

}  // namespace rvbench
