#include <catch2/catch.hpp>
#include <string>

#include "bench/find_plan.hpp"
#include "bench/text_file.hpp"
#include "hal/types/measure.hpp"
#include "sequences/plan.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

// The quick plan with its limits replaced by one.
std::string quick_with_limit(const std::string& limit) {
  const std::string resolved = sequences::plan_to_json(std::get<0>(find_plan("quick")));
  const auto limits = resolved.find("\"limits\"");
  return resolved.substr(0, limits) + "\"limits\": [{" + limit + "}]}";
}

}  // namespace

TEST_CASE("check and a dry run tell a limit that nothing can be held against", "[bench]") {
  const ScratchFolder scratch;
  const std::string plan = (scratch.path() / "plan.json").string();
  const auto [limit, told] = GENERATE(table<std::string, std::string>({
      {R"("measure": "sideband_ration", "max": 1, "why": "x")", "did you mean \"sideband_ratio\"?"},
      {R"("measure": "fm4", "unit": "m/s²", "max": 1, "why": "x")", "fm4 is a pure number"},
      {R"("measure": "band_rms", "unit": "N", "max": 1, "why": "x")",
       "/limits/0/unit: expected one"},
      {R"("measure": "fm4", "of": "sun-planet mesh, sun against carier", "max": 6, "why": "x")",
       "did you mean \"sun-planet mesh, sun against carrier\"?"},
      {R"("measure": "fm4", "max": 6)", "/limits/0/why: this key is missing"},
      {R"("measure": "lost_motion", "unit": "arcmin", "max": 1, "why": "x")",
       "/limits/0/measure: lost_motion needs a hysteresis_loop phase"},
      {R"("measure": "na4", "max": 9, "why": "x")",
       "/limits/0/measure: na4 needs a point that main records more than once"},
  }));
  CAPTURE(limit);
  write_file(plan, quick_with_limit(limit));
  const CommandAnswer checked = rvbench({"check", plan});
  CHECK(checked.code == 3);
  CHECK_THAT(checked.err, Contains("/limits/0/") && Contains(told));
  const CommandAnswer dry = rvbench({"run", plan, "--rig", "sim", "--dry-run"});
  CHECK(dry.code == 3);
  CHECK_THAT(dry.err, Contains(told));
}

TEST_CASE("a limit on any indicator of the RV-20E is no fault", "[bench]") {
  const ScratchFolder scratch;
  const std::string plan = (scratch.path() / "plan.json").string();
  const std::string limit = GENERATE(
      R"("measure": "fm4", "of": "sun-planet mesh, sun against carrier", "max": 6, "why": "x")",
      R"("measure": "band_rms", "of": "above the meshes", "unit": "g", "max": 1, "why": "x")",
      R"("measure": "envelope_order_level", "of": "input shaft", "max": 0.2, "why": "x")",
      R"("measure": "torque_ripple", "of": "input_torque", "max": 1, "why": "x")");
  CAPTURE(limit);
  write_file(plan, quick_with_limit(limit));
  CHECK(rvbench({"check", plan}).err.empty());
  CHECK(rvbench({"run", plan, "--rig", "sim", "--dry-run"}).code == 0);
}

TEST_CASE("a limit on what the rig does not record is no fault of the plan, but no run begins",
          "[bench]") {
  const ScratchFolder scratch;
  const std::string plan = (scratch.path() / "plan.json").string();
  const auto [limit, told] = GENERATE(table<std::string, std::string>({
      {R"("measure": "efficiency", "min": 0.7, "why": "x")",
       "/limits/0/measure: efficiency takes output_torque and output_angle, which the rig does "
       "not record"},
      {R"("measure": "transmission_error", "unit": "arcsec", "max": 60, "why": "x")",
       "/limits/0/measure: transmission_error takes output_angle, which"},
      {R"("measure": "torque_ripple", "of": "output_torque", "max": 1, "why": "x")",
       "/limits/0/of: torque_ripple takes output_torque, which"},
  }));
  CAPTURE(limit);
  write_file(plan, quick_with_limit(limit));
  CHECK(rvbench({"check", plan}).code == 0);
  const CommandAnswer dry = rvbench({"run", plan, "--rig", "sim", "--dry-run"});
  CHECK(dry.code == 3);
  CHECK_THAT(dry.err, Contains(told));
  const CommandAnswer run = rvbench(
      {"run", plan, "--rig", "sim", "--serial", "A1", "--out", (scratch.path() / "runs").string()});
  CHECK(run.code == 3);
  CHECK_THAT(run.err, Contains(told));
}

TEST_CASE("the README tells of every measure", "[bench]") {
  const std::string readme = read_file(test::source_dir() / "README.md").value_or("");
  for (const Measure& measure : measures()) {
    CAPTURE(measure.name);
    CHECK_THAT(readme, Contains("`" + std::string(measure.name) + "`"));
  }
}

}  // namespace rvbench::bench
