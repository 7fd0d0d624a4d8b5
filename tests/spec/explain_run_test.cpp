#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/judgement.hpp"
#include "bench/rig_factory.hpp"
#include "bench/sha256.hpp"
#include "bench/simulated_recording.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "sim/rv_plant.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/rv_campaign.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

// `rvbench explain RUN` from outside: what a run left in its folder, beside the bench's plant.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using nlohmann::json;
using test::Answer;
using test::ScratchFolder;

Answer explain(const ScratchFolder& scratch, std::vector<std::string> words) {
  words.insert(words.begin(), "explain");
  return test::rvbench(scratch.path(), words);
}

void refused(const Answer& answer, int code, const std::string& told) {
  INFO(answer.out);
  CHECK(answer.code == code);
  CHECK_THAT(answer.err, Contains(told));
}

// The folder of a run that passed, with a transducer's records only: nothing of a rig is in them
// but what the plant makes of its plan.
void write_run(const std::filesystem::path& folder, const bench::Campaign& measured) {
  std::filesystem::create_directories(folder);
  std::vector<Recording> points;
  for (const bench::CampaignRecord& record : measured.records) points.push_back(record.recording);
  REQUIRE(bench::write_hdf5(folder / "recording.h5", points));
  const auto plan = test::plan_of(test::short_plan);
  bench::write_file(folder / "plan.json", sequences::plan_to_json(plan));
  bench::write_file(folder / "rig.json", bench::rig_to_json("sim", {}));
  bench::Judgement passed;
  passed.ending.outcome = Outcome::pass;
  bench::write_file(folder / "verdict.json", bench::judgement_to_json(passed));
  bench::write_sums(folder);
}

test::RvMatrix twelve_records() {
  test::RvMatrix matrix;
  matrix.speeds_rpm = {1210, 1815};
  matrix.loads_pct = {0, 150};
  return matrix;
}

}  // namespace

TEST_CASE("a run of a bench that is as on its drawing lacks nothing", "[spec][explain]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder scratch;
  write_run(scratch / "run", test::rv_campaign(sim::rv20e_bench(), 5, twelve_records()));
  const Answer answer = explain(scratch, {"run", "--json"});
  INFO(answer.err);
  INFO(answer.out);
  REQUIRE(answer.code == 0);
  const json said = json::parse(answer.out);
  CHECK(said.at("verdict") == "NULL");
  CHECK(said.at("effects").empty());
  CHECK(said.at("plant") == "rv20e_bench");
  CHECK(said.at("records").size() == 12);
  CHECK(said.at("records")[0].at("record") == "1210 rpm, 0 %, repeat 1");
  CHECK(json::parse(bench::read_file(scratch / "run/explain.json").value()) == said);
  THEN("the folder is still sound, and can be explained again") {
    CHECK(std::filesystem::exists(scratch / "run/explain.html"));
    CHECK(bench::verify_sums(scratch / "run").empty());
  }
}

TEST_CASE("a run that is too short to leave conditions out is told so", "[spec][explain]") {
  const ScratchFolder scratch;
  bench::write_file(
      scratch / "short.json",
      test::replaced(test::replaced(test::short_plan, "[1210]", "[1815]"), "[50]", "[50, 100]"));
  const Answer ran =
      test::rvbench(scratch.path(), {"run", "short.json", "--rig", "sim", "--serial", "A17"});
  INFO(ran.err);
  REQUIRE(ran.code == 0);
  const auto run = std::filesystem::directory_iterator(scratch / "runs/A17")->path();
  const Answer answer = explain(scratch, {run.string()});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.out, Contains("NOT_RESOLVABLE  2 stretches under 2 conditions are too few"));
  CHECK(bench::verify_sums(run).empty());

  const std::string recording = run / "recording.h5";
  const Answer same = explain(scratch, {"--plant", "rv20e_bench", "--rec", recording});
  CHECK_THAT(same.out, Contains("2 stretches under 2 conditions"));

  refused(explain(scratch, {"--plant", "emps", "--rec", recording}), 20,
          "2 of 2 records, \"1815 rpm, 50 %, repeat 1\" the first: the recording has no channel");

  bench::write_file(run / "plan.json", "{}");
  refused(explain(scratch, {run.string()}), 20, "plan.json: does not match its hash");
}

TEST_CASE("what is no run that came to its end is refused", "[spec][explain]") {
  const ScratchFolder scratch;
  refused(explain(scratch, {"nowhere"}), 20, "nowhere: there is no such folder");
  std::filesystem::create_directories(scratch / "empty");
  refused(explain(scratch, {"empty"}), 20, "no run folder: it holds no plan.json");
  bench::write_file(scratch / "empty/plan.json", test::short_plan);
  refused(explain(scratch, {"empty"}), 20, "has not come to its end");
  refused(explain(scratch, {}), 2, "RUN or --rec is required");
  refused(explain(scratch, {"--rec", "a.csv"}), 2, "--plant is required");
  refused(explain(scratch, {"empty", "--rec", "a.csv"}), 2, "a run folder needs no --rec");
  refused(explain(scratch, {"empty", "--rate", "500"}), 2, "a run states its rates");
}

}  // namespace rvbench
