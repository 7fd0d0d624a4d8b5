#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/plan_files.hpp"
#include "bench/result_database.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/entered_run.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

// The two points of the quick plan at 1815 rpm, as a plan of its own.
void write_plan(const ScratchFolder& scratch, const std::string& name = "quick") {
  const auto quick = std::ranges::find(plan_files(), "quick", &EmbeddedFile::name);
  auto plan = nlohmann::ordered_json::parse(quick->text);
  plan["name"] = name;
  plan["main"][0]["speeds_rpm"] = {1815};
  plan["limits"] = {plan["limits"][0]};  // of the peak
  write_file(scratch / "two.json", plan.dump(2));
}

struct Run {
  CommandAnswer answer;
  nlohmann::json verdict;
  Judgement judgement;
};

// The same healthy unit each time, under another serial.
Run run(const ScratchFolder& scratch, const std::string& serial) {
  Run run;
  run.answer = rvbench({"run", (scratch / "two.json").string(), "--rig", "sim", "--serial", serial,
                        "--out", (scratch / "runs").string(), "--no-report"});
  const auto folder = std::filesystem::directory_iterator(scratch / "runs" / serial)->path();
  const std::string text = read_file(folder / "verdict.json").value();
  run.verdict = nlohmann::json::parse(text);
  run.judgement = judgement_from_json(text).value();
  return run;
}

// Thirty units like that one, peaks times `of_peak` at each of its points, and within 3 %.
// @return a file of their serials
std::string enter_alike(const ScratchFolder& scratch, const Judgement& unit,
                        const std::string& prefix, const std::vector<double>& of_peak) {
  std::string serials;
  for (int i = 0; i < 30; ++i) {
    Judgement judgement = unit;
    judgement.facts.serial = fmt::format("{}{:02}", prefix, i);
    for (std::size_t p = 0; p < judgement.points.size(); ++p) {
      for (auto& channel : judgement.points[p].examination.channels) {
        for (analysis::Indicator& indicator : channel.indicators) {
          if (indicator.measure != "acceleration_peak") continue;
          indicator.value *= of_peak[p] * (1 + 0.03 * std::sin(1.0 + i));
        }
      }
    }
    judgement.facts.started_utc = "20260102T030405Z";
    test::enter_run(scratch / "runs", judgement);
    serials += judgement.facts.serial + "\n";
  }
  write_file(scratch / (prefix + ".txt"), serials);
  return (scratch / (prefix + ".txt")).string();
}

// @param plan  its file; or its name, as the runs have it
void learn_and_activate(const ScratchFolder& scratch, const std::string& version,
                        const std::string& serials, std::vector<std::string> more = {},
                        const std::string& plan = "two.json") {
  const auto step = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "limits");
    words.insert(words.end(), {"--by", "A. Sato", "--out", (scratch / "runs").string()});
    const CommandAnswer answer = rvbench(words);
    CAPTURE(answer.out, answer.err);
    REQUIRE(answer.code == 0);
  };
  const bool is_file = plan.ends_with(".json");
  std::vector<std::string> learn{
      "learn", version, "--plan", is_file ? (scratch / plan).string() : plan, "--serials", serials};
  learn.insert(learn.end(), more.begin(), more.end());
  step(learn);
  step({"approve", version, "--yes"});
  step({"activate", version});
}

}  // namespace

TEST_CASE("a run is judged by limits that were learnt, approved and activated", "[bench][limits]") {
  if (test::too_long_under_sanitizer()) return;
  const ScratchFolder scratch;
  write_plan(scratch, "two");
  const Run first = run(scratch, "A17");
  REQUIRE(first.answer.code == 0);
  CHECK(first.verdict.at("run").at("limits_version").is_null());

  // Units alike: a further one passes by what they taught.
  learn_and_activate(scratch, "v1", enter_alike(scratch, first.judgement, "alike", {1, 1}));
  const Run good = run(scratch, "B");
  CHECK(good.answer.code == 0);
  CHECK(good.verdict.at("verdict") == "PASS");
  CHECK(good.verdict.at("run").at("limits_version") == "v1");
  REQUIRE(good.verdict.at("limits").size() == 1);
  CHECK(good.verdict["limits"][0].at("max") < 1.0);  // the plan's
  CHECK_THAT(good.verdict["limits"][0].at("why").get<std::string>(), Contains("30 good units"));

  // Quieter ones: the same unit is beyond what they taught.
  learn_and_activate(scratch, "v2", enter_alike(scratch, first.judgement, "quiet", {0.5, 0.5}), {},
                     "two");
  const Run bad = run(scratch, "C");
  CHECK(bad.answer.code == 10);
  CHECK(bad.verdict.at("verdict") == "FAIL");
  CHECK(bad.verdict.at("run").at("limits_version") == "v2");
  CHECK_THAT(bad.verdict.at("reason").get<std::string>(),
             Contains("acceleration_peak") && Contains("above its max"));
  CHECK_FALSE(bad.verdict.at("limits")[0].at("passed").get<bool>());
}

TEST_CASE("a unit beyond the limit of one point fails by its name, and no other point",
          "[bench][limits]") {
  const ScratchFolder scratch;
  write_plan(scratch);
  const Run first = run(scratch, "A17");
  learn_and_activate(scratch, "v1", enter_alike(scratch, first.judgement, "at_full", {1, 0.5}),
                     {"--per-point"});
  const Run bad = run(scratch, "B");
  CHECK(bad.answer.code == 10);
  CHECK_THAT(bad.verdict.at("reason").get<std::string>(),
             Contains("acceleration_peak at 1815 rpm, 100 % load: ") && Contains("above its max"));
  std::size_t failed = 0;
  for (const auto& check : bad.verdict.at("limits")) failed += check.at("passed") == false ? 1 : 0;
  CHECK(failed == 1);

  learn_and_activate(scratch, "v2", enter_alike(scratch, first.judgement, "alike", {1, 1}),
                     {"--per-point"});
  const Run good = run(scratch, "C");
  CHECK(good.answer.code == 0);
  CHECK(good.verdict.at("limits").size() == 3);  // the plan's, and one for each point
}

TEST_CASE("no run begins on active limits for a point that its plan does not record",
          "[bench][limits]") {
  const ScratchFolder scratch;
  write_plan(scratch);
  const std::string runs = (scratch / "runs").string();
  write_file(scratch / "far.json",
             R"({"limits_version": "far", "plan": "quick", "limits": [
  {"measure": "kurtosis", "max": 9, "speed_rpm": 1210, "load_pct": 50, "why": "a test"}]})");
  const auto limits = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "limits");
    words.insert(words.end(), {"--by", "A. Sato", "--out", runs});
    return rvbench(words).code;
  };
  CHECK(limits({"propose", "--from", (scratch / "far.json").string()}) == 0);
  CHECK(limits({"approve", "far", "--yes"}) == 0);
  CHECK(limits({"activate", "far"}) == 0);
  const CommandAnswer refused = rvbench(
      {"run", (scratch / "two.json").string(), "--rig", "sim", "--serial", "A17", "--out", runs});
  CHECK(refused.code == 3);
  CHECK_THAT(refused.err,
             Contains("limits/far.json:") && Contains("/limits/0/speed_rpm") &&
                 Contains("no point of the plan shows kurtosis at 1210 rpm, 50 % load"));
  CHECK_FALSE(std::filesystem::exists(scratch / "runs" / "A17"));
}

}  // namespace rvbench::bench
