#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/acceptance.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_recordings.hpp"
#include "bench/text_file.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/under_sanitizer.hpp"

// Run folders of simulated units, before and after, with the program as it is shipped.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;

std::string plan_with(const std::string& loads, int repeats) {
  const std::string text =
      test::replaced(test::replaced(test::short_plan, "[1210]", "[1815]"), "[50]", loads);
  return test::replaced(text, "\"settling\"",
                        "\"repeats\": " + std::to_string(repeats) + ", \"settling\"");
}

// The run of a unit whose parts and bench are those of a seed, its noise another's.
void run_unit(const std::filesystem::path& folder, const std::string& preset,
              std::uint64_t noise_seed, const std::string& plan_text = plan_with("[50, 100]", 3)) {
  std::filesystem::create_directories(folder);
  const sequences::TestPlan plan = test::plan_of(plan_text);
  bench::write_file(folder / "plan.json", sequences::plan_to_json(plan));
  bench::write_file(folder / "kinematics.json", bench::kinematics_text(plan.specimen.kinematics));
  sim::RvUnit unit = sim::draw_unit(preset, 1);
  unit.noise_seed = noise_seed;
  auto world = std::make_unique<sim::BenchWorld>(unit);
  const hal::SimulatedRigOptions options{.torque_rate_Hz = world->transducer().rate_Hz()};
  hal::Rig rig = hal::make_simulated_rig(std::move(world), options);
  std::ostringstream out;
  bench::Console console{out, out};
  bench::ProgressBar bar(console, bench::ProgressBar::Style::silent);
  const auto kinematics = std::get<0>(bench::read_kinematics(plan.specimen.kinematics));
  bench::run_acceptance({plan, kinematics, folder, {}}, rig, bar, {});
}

nlohmann::json compared(const test::ScratchFolder& scratch) {
  const test::Answer answer = test::rvbench(scratch.path(), {"compare", "a", "b", "--json"});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  return nlohmann::json::parse(answer.out);
}

}  // namespace

TEST_CASE("a unit that is measured again has not changed", "[spec][compare]") {
  if (test::too_long_under_sanitizer()) return;
  const test::ScratchFolder scratch;
  run_unit(scratch.path() / "a", "healthy", 11);
  run_unit(scratch.path() / "b", "healthy", 12);
  const auto told = compared(scratch);
  CHECK(told.at("verdict") == "not_changed");
  CHECK(told.at("changed").empty());
  CHECK(told.at("families").empty());
  CHECK(told.at("counts").at("not_changed") > told.at("counts").at("cannot_tell"));
}

TEST_CASE("a reducer that was replaced shows the lines of its bad part", "[spec][compare]") {
  if (test::too_long_under_sanitizer()) return;
  const test::ScratchFolder scratch;
  run_unit(scratch.path() / "b", "healthy", 12, plan_with("[100]", 3));
  for (const auto& [preset, component] : {std::pair{"input_shaft", "input_shaft"},
                                          {"planet_tooth", "planet_gear"},
                                          {"cycloid_pin", "pin_housing"},
                                          {"crank_bearing", "bearing_inner"}}) {
    CAPTURE(preset);
    std::filesystem::remove_all(scratch.path() / "a");
    run_unit(scratch.path() / "a", preset, 11, plan_with("[100]", 3));
    const auto told = compared(scratch);
    CHECK(told.at("verdict") == "changed");
    REQUIRE_FALSE(told.at("families").empty());
    CHECK(told.at("families").at(0).at("component") == component);
    CHECK(told.at("families").at(0).at("median_dB") < -3);  // the new one is better
  }
}

TEST_CASE("a matrix that was measured in part is compared where it can be", "[spec][compare]") {
  if (test::too_long_under_sanitizer()) return;
  const test::ScratchFolder scratch;
  run_unit(scratch.path() / "a", "healthy", 11, plan_with("[50, 100]", 1));
  run_unit(scratch.path() / "b", "healthy", 12, plan_with("[150, 50]", 1));
  const auto told = compared(scratch);
  REQUIRE(told.at("points").size() == 1);
  CHECK(told.at("points").at(0).at("load_pct") == 50);
  REQUIRE(told.at("only_in_a").size() == 1);
  CHECK(told.at("only_in_a").at(0).at("load_pct") == 100);
  REQUIRE(told.at("only_in_b").size() == 1);
  CHECK(told.at("only_in_b").at(0).at("load_pct") == 150);
  const test::Answer noted = test::rvbench(scratch.path(), {"compare", "a", "b", "--rate", "1000"});
  CHECK_THAT(noted.err, Contains("a is a run folder, which states its own speeds and rates"));
  for (const auto& change : told.at("points").at(0).at("changes")) {
    CHECK(change.at("scatter") != "repeats");
  }
  CHECK(told.at("verdict") != "changed");
}

TEST_CASE(
    "of real bearings whose fault grew that part is named, or named with what it cannot be told "
    "from",
    "[spec][compare]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const std::filesystem::path data = *folder / "cwru";
  struct Pair {
    std::string a, b, same, may_be;
  };
  const auto [a, b, same, may_be] = GENERATE(values<Pair>({
      {"IR007_0", "IR021_0", "X105_DE_time=X209_DE_time", "bearing_inner"},
      {"IR007_0", "IR014_0", "X105_DE_time=X169_DE_time", "bearing_inner"},
      {"IR007_1", "IR021_1", "X106_DE_time=X210_DE_time", "bearing_inner"},
      {"OR007@6_0", "OR021@6_0", "X130_DE_time=X234_DE_time", "bearing_outer"},
      {"OR014@6_0", "OR021@6_0", "X197_DE_time=X234_DE_time", "bearing_outer"},
      {"B007_0", "OR007@6_0", "X118_DE_time=X130_DE_time", "bearing_outer"},
  }));
  CAPTURE(a, b);
  const test::ScratchFolder scratch;
  const test::Answer answer = test::rvbench(
      scratch.path(), {"compare", (data / (a + ".mat")).string(), (data / (b + ".mat")).string(),
                       "--kinematics", "cwru_6205", "--rate", "12000", "--same", same, "--json"});
  REQUIRE(answer.code == 0);
  std::vector<std::string> names;  // of the first of the bearing's parts, and of what it may be
  const auto told = nlohmann::json::parse(answer.out);
  for (const auto& family : told.at("families")) {
    if (family.at("component") == "motor") continue;  // its own lines differ from run to run
    names.push_back(family.at("component"));
    for (const auto& other : family.at("or")) names.push_back(other.at("component"));
    break;
  }
  CHECK(std::ranges::find(names, may_be) != names.end());
  CHECK(names.size() <= 2);
}

namespace {

// Halves of a real recording, as two recordings of one column each.
void write_halves(const std::filesystem::path& file, const std::string& channel,
                  const std::filesystem::path& folder) {
  const auto records = hal::read_recordings(file, {.rate_Hz = 12000});
  REQUIRE(records);
  const Eigen::VectorXd& x = records.value().front().find(channel)->samples;
  const Eigen::Index half = x.size() / 2;
  for (const auto& [name, from] : {std::pair{"a.csv", Eigen::Index{0}}, {"b.csv", half}}) {
    std::ofstream out(folder / name);
    out << "accel_1x\n";
    for (const double sample : x.segment(from, half)) out << sample << '\n';
  }
}

}  // namespace

TEST_CASE("of the halves of one recording of a real bearing nothing is named", "[spec][compare]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const auto [file, channel] = GENERATE(table<std::string, std::string>(
      {{"IR007_0", "X105_DE_time"}, {"OR021@6_0", "X234_DE_time"}, {"B007_0", "X118_DE_time"}}));
  CAPTURE(file);
  const test::ScratchFolder scratch;
  write_halves(*folder / "cwru" / (file + ".mat"), channel, scratch.path());
  const test::Answer answer =
      test::rvbench(scratch.path(), {"compare", "a.csv", "b.csv", "--kinematics", "cwru_6205",
                                     "--rate", "12000", "--speed", "1797", "--json"});
  REQUIRE(answer.code == 0);
  const auto told = nlohmann::json::parse(answer.out);
  CHECK(told.at("families").empty());
  CHECK(told.at("verdict") != "changed");
}

TEST_CASE("runs of two machines are not compared", "[spec][compare]") {
  const test::ScratchFolder scratch;
  run_unit(scratch.path() / "a", "healthy", 11, plan_with("[50]", 1));
  std::filesystem::copy(scratch.path() / "a", scratch.path() / "b");
  bench::write_file(scratch.path() / "b" / "kinematics.json", bench::kinematics_text("two_stage"));
  const test::Answer answer = test::rvbench(scratch.path(), {"compare", "a", "b"});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("another machine"));
}

}  // namespace rvbench
