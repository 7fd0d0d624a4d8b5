#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/limits_versions.hpp"
#include "bench/plan_files.hpp"
#include "bench/rejudging.hpp"
#include "bench/results/rejudgement.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

namespace {

// Limits for the plan "quick": a bound that no unit keeps to, or one that all do.
std::string limits_text(const std::string& version, const std::string& max_g,
                        const std::string& plan = "quick") {
  return R"({"limits_version": ")" + version + R"(", "plan": ")" + plan +
         R"(", "limits": [{"measure": "acceleration_peak", "unit": "g", "max": )" + max_g +
         R"(, "why": "a test"}]})";
}

// A healthy unit's run of one point of the quick plan.
std::filesystem::path make_run(const ScratchFolder& scratch) {
  const auto quick = std::ranges::find(plan_files(), "quick", &EmbeddedFile::name);
  auto plan = nlohmann::ordered_json::parse(quick->text);
  plan["main"][0]["speeds_rpm"] = {1815};
  plan["main"][0]["loads_pct"] = {100};
  write_file(scratch / "one.json", plan.dump(2));
  const CommandAnswer run =
      rvbench({"run", (scratch / "one.json").string(), "--rig", "sim", "--serial", "A17", "--out",
               (scratch / "runs").string(), "--no-report"});
  REQUIRE(run.code == 0);
  return std::filesystem::directory_iterator(scratch / "runs/A17")->path();
}

// The same, measured once for all: for those to whom it is the same where it was measured.
void copy_run(const ScratchFolder& scratch) {
  static const ScratchFolder kept;
  if (!std::filesystem::exists(kept / "runs")) make_run(kept);
  std::filesystem::copy(kept.path(), scratch.path(), std::filesystem::copy_options::recursive);
}

}  // namespace

TEST_CASE("a stored run is judged again, and both judgements stay", "[bench][results]") {
  const ScratchFolder scratch;
  const auto folder = make_run(scratch);
  const std::string runs = (scratch / "runs").string();
  const std::string verdict = read_file(folder / "verdict.json").value();

  // By the same program with the same limits it comes to the same, from samples or from verdict.
  const auto stored = std::get<StoredRun>(read_stored_run(folder));
  const Judgement from_verdict = judged_by_limits(stored, stored.plan.limits);
  CHECK(from_verdict.ending.outcome == Outcome::pass);
  // By other limits, too: what both have in common is concluded once, and depths that differ anew.
  const sequences::Limit peak{"acceleration_peak", "", "g", 0.0001, "a test"};
  const sequences::Limit depth{"modulation_depth", "input_shaft", "1", 0.9, "a test"};
  for (const std::vector<sequences::Limit>& others :
       {std::vector{peak}, std::vector{depth}, std::vector{peak, depth}}) {
    const auto [own, other] = endings_by_limits(stored, others);
    const Ending alone = judged_by_limits(stored, others).ending;
    CHECK(own.reason == from_verdict.ending.reason);
    CHECK(other.outcome == alone.outcome);
    CHECK(other.reason == alone.reason);
  }
  const CommandAnswer same = rvbench({"rejudge", folder.string(), "--json"});
  CHECK(same.code == 0);
  const auto told = nlohmann::json::parse(same.out).at("runs").at(0);
  CHECK(told.at("as_judged") == told.at("rejudged"));
  const auto first = rejudgement_from_json(read_file(folder / "rejudged-1.json").value());
  REQUIRE(first);
  const auto then = nlohmann::json::parse(verdict);
  const auto now = nlohmann::json::parse(read_file(folder / "rejudged-1.json").value());
  CHECK(now.at("points") == then.at("points"));
  CHECK(now.at("quality") == then.at("quality"));

  // By limits that it does not keep to.
  write_file(scratch / "limits.json", limits_text("strict", "0.0001"));
  const CommandAnswer strict =
      rvbench({"rejudge", folder.string(), "--limits", (scratch / "limits.json").string()});
  CHECK(strict.code == 10);
  CHECK_THAT(strict.out, Contains("as judged then  PASS") && Contains("re-judged       FAIL"));

  CHECK(read_file(folder / "verdict.json") == verdict);
  CHECK(rvbench({"check", folder.string()}).code == 0);
  CHECK(rejudgement_names(folder) ==
        std::vector<std::string>{"rejudged-1.json", "rejudged-2.json"});
  const CommandAnswer history = rvbench({"history", "--out", runs});
  CHECK_THAT(history.out,
             Contains("PASS") && Contains("re-judged") && Contains("by limits strict: acceler"));
  const auto listed = nlohmann::json::parse(rvbench({"history", "--out", runs, "--json"}).out);
  CHECK(listed.at("runs").at(0).at("verdict") == "PASS");
  CHECK(listed.at("runs").at(0).at("rejudged").size() == 2);
  CHECK(listed.at("runs").at(0).at("rejudged").at(1).at("limits_version") == "strict");

  SECTION("an index that is made anew has them, too") {
    std::filesystem::remove(scratch / "runs/results.db");
    CHECK(nlohmann::json::parse(rvbench({"history", "--out", runs, "--json"}).out) == listed);
  }
  SECTION("of a run that was tampered with nothing is blessed") {
    write_file(folder / "log.jsonl", "{}\n");
    const CommandAnswer refused = rvbench({"rejudge", folder.string()});
    CHECK(refused.code == 3);
    CHECK_THAT(refused.err, Contains("log.jsonl: does not match its hash"));
    CHECK(rejudgement_names(folder).size() == 2);
  }
  SECTION("of several runs those that were judged are told beside one that is refused") {
    const std::string none = (scratch / "runs/A17").string();
    const CommandAnswer both = rvbench({"rejudge", none, folder.string(), "--json"});
    CHECK(both.code == 3);
    const auto all = nlohmann::json::parse(both.out);
    REQUIRE(all.at("runs").size() == 1);
    CHECK(all.at("runs").at(0).at("file") == "rejudged-3.json");
    CHECK(all.at("verdict").is_null());
    CHECK_THAT(all.at("reason").get<std::string>(), Contains("A17"));
    CHECK(all.at("exit_code") == 3);
  }
  SECTION("limits of another plan, and faulty ones, are refused") {
    write_file(scratch / "limits.json", limits_text("strict", "1", "other"));
    const std::string file = (scratch / "limits.json").string();
    CHECK(rvbench({"check", file}).code == 0);
    const CommandAnswer other = rvbench({"rejudge", folder.string(), "--limits", file});
    CHECK(other.code == 20);
    CHECK_THAT(other.err, Contains("limits runs of plan \"other\""));
    write_file(scratch / "limits.json", limits_text("strict", "\"much\""));
    CHECK_THAT(rvbench({"rejudge", folder.string(), "--limits", file}).err,
               Contains("/limits/0/max"));
    CHECK(rvbench({"check", file}).code == 3);
  }
}

TEST_CASE("limits go from draft to approved to active, their effect being shown first",
          "[bench][results]") {
  if (rvbench::test::too_long_under_sanitizer()) return;
  const ScratchFolder scratch;
  copy_run(scratch);
  const std::string runs = (scratch / "runs").string();
  const std::string from = (scratch / "limits.json").string();
  const auto limits = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "limits");
    words.insert(words.end(), {"--out", runs});
    return rvbench(words);
  };
  CHECK_THAT(limits({"list"}).out, Contains("no limits in "));
  CHECK(nlohmann::json::parse(limits({"list", "--json"}).out).at("versions").empty());
  write_file(from, limits_text("v1", "0.0001"));
  CHECK(limits({"propose", "--from", from}).code == 2);  // nobody's
  CHECK(limits({"propose", "--from", from, "--by", "J. Weber"}).code == 0);
  CHECK_THAT(limits({"propose", "--from", from, "--by", "J. Weber"}).err,
             Contains("there was a version v1"));
  CHECK_THAT(limits({"list"}).out, Contains("v1  draft") && Contains("proposed by J. Weber"));

  const CommandAnswer too_soon = limits({"activate", "v1", "--by", "A. Sato"});
  CHECK(too_soon.code == 2);
  CHECK_THAT(too_soon.err, Contains("v1 is a draft"));
  const CommandAnswer shown = limits({"approve", "v1", "--by", "A. Sato"});
  CHECK_THAT(shown.out, Contains("1 of 1 verdicts would change: 1 PASS to FAIL") &&
                            Contains("A17") && Contains("nothing is approved yet"));
  CHECK_THAT(limits({"list"}).out, Contains("v1  draft"));
  const auto effect = nlohmann::json::parse(limits({"effect", "v1", "--json"}).out).at("effect");
  CHECK(effect.at("runs") == 1);
  CHECK(effect.at("left_out") == 0);
  REQUIRE(effect.at("changes").size() == 1);
  CHECK_THAT(effect.at("changes")[0].at("folder").get<std::string>(), Contains("A17/"));
  CHECK(effect.at("changes")[0].at("was") == "PASS");
  CHECK(effect.at("changes")[0].at("would_be") == "FAIL");
  CHECK_THAT(effect.at("changes")[0].at("reason").get<std::string>(),
             Contains("acceleration_peak"));
  CHECK_THAT(limits({"approve", "v1", "--by", "A. Sato", "--json"}).err,
             Contains("--json is for list and effect"));
  CHECK(limits({"approve", "v1", "--by", "A. Sato", "--yes"}).code == 0);
  CHECK(active_limits(runs, "quick").index() == 0);
  CHECK_FALSE(std::get<0>(active_limits(runs, "quick")));
  CHECK(limits({"activate", "v1", "--by", "A. Sato"}).code == 0);
  CHECK_THAT(limits({"list"}).out, Contains("v1  activated, in force, plan quick, 1 limits") &&
                                       Contains("approved by A. Sato"));
  const auto listed = nlohmann::json::parse(limits({"list", "--json"}).out).at("versions").at(0);
  CHECK(listed.at("limits_version") == "v1");
  CHECK(listed.at("status") == "activated");
  CHECK(listed.at("steps").size() == 3);
  CHECK(listed.at("limits").at(0).at("max") == 0.0001);
  CHECK(std::get<0>(active_limits(runs, "quick"))->version == "v1");
  CHECK_FALSE(std::get<0>(active_limits(runs, "other")));
  CHECK_THAT(limits({"effect", "v2"}).err, Contains("no version \"v2\"") && Contains("v1"));
  CHECK(limits({"effect", "../A17"}).code == 2);

  SECTION("a run takes the active limits, and says so") {
    const CommandAnswer run = rvbench({"run", (scratch / "one.json").string(), "--rig", "sim",
                                       "--serial", "B", "--out", runs, "--no-report"});
    CHECK(run.code == 10);
    CHECK_THAT(run.err, Contains("limits v1 are active"));
    const auto folder = std::filesystem::directory_iterator(scratch / "runs/B")->path();
    CHECK_THAT(read_file(folder / "log.jsonl").value(), Contains("limits v1 are active"));
    CHECK_THAT(read_file(folder / "plan.json").value(), Contains("0.0001"));
  }
  SECTION("those in force are missed: no older ones come back by themselves") {
    const std::string second = (scratch / "second.json").string();
    std::string text = read_file(from).value();
    text.replace(text.find("v1"), 2, "v2");
    write_file(second, text);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"propose", "--from", second},
          {"approve", "v2", "--yes"},
          {"activate", "v2"}}) {
      std::vector<std::string> step = words;
      step.insert(step.end(), {"--by", "A. Sato"});
      REQUIRE(limits(step).code == 0);
    }
    CHECK_THAT(limits({"list"}).out, Contains("v1  activated, plan quick") &&
                                         Contains("v2  activated, in force, plan quick"));
    std::filesystem::remove(limits_path(runs, "v2"));
    const CommandAnswer run = rvbench(
        {"run", (scratch / "one.json").string(), "--rig", "sim", "--serial", "B", "--out", runs});
    CHECK(run.code == 2);
    CHECK_THAT(run.err,
               Contains("of the limits in force for plan quick") && Contains("v2.json is missing"));
    const CommandAnswer told = limits({"list"});
    CHECK(told.code == 0);
    CHECK_THAT(told.out, Contains("v2  missing, in force"));
    CHECK(limits({"activate", "v1", "--by", "A. Sato"}).code == 0);  // somebody's decision
    CHECK(std::get<0>(active_limits(runs, "quick"))->version == "v1");
  }
  SECTION("limits of another plan under the name of those in force are none of this plan") {
    std::filesystem::remove(limits_path(runs, "v1"));
    std::string other = read_file(from).value();
    other.replace(other.find("quick"), 5, "other");
    write_file(from, other);
    const CommandAnswer taken = limits({"propose", "--from", from, "--by", "J. Weber"});
    CHECK(taken.code == 2);
    CHECK_THAT(limits({"activate", "v1", "--by", "A. Sato"}).err, Contains("v1.json is missing"));
  }
  SECTION("older limits do not come back with the ledger's last line") {
    const auto ledger = scratch / "runs" / ledger_name;
    std::string text = read_file(ledger).value();
    text.pop_back();  // an editor's doing: the line is whole all the same
    write_file(ledger, text);
    CHECK(std::get<0>(active_limits(runs, "quick"))->version == "v1");
    text.erase(text.rfind('\n') + 1);
    write_file(ledger, text);
    CHECK_THAT(std::get<1>(active_limits(runs, "quick")), Contains("says that it is active"));
  }
  SECTION("a file that somebody put there is told, and nobody runs before it is gone") {
    write_file(limits_path(runs, "by_hand"), "{");
    const CommandAnswer told = limits({"list"});
    CHECK(told.code == 0);
    CHECK_THAT(told.out, Contains("by_hand  damaged") && Contains("cannot be read"));
    CHECK_THAT(std::get<1>(active_limits(runs, "quick")), Contains("take it away"));
  }
  SECTION("without the ledger nobody knows whether they are in force") {
    std::filesystem::remove(scratch / "runs" / ledger_name);
    CHECK_THAT(std::get<1>(active_limits(runs, "quick")), Contains("says that it is active"));
    CHECK_THAT(limits({"list"}).out, Contains("v1  draft"));
  }
  SECTION("what is changed after its approval is neither used nor activated") {
    const auto path = limits_path(runs, "v1");
    std::string text = read_file(path).value();
    text.replace(text.find("0.0001"), 6, "9.0001");
    write_file(path, text);
    const CommandAnswer run = rvbench(
        {"run", (scratch / "one.json").string(), "--rig", "sim", "--serial", "B", "--out", runs});
    CHECK(run.code == 2);
    CHECK_THAT(run.err, Contains("v1.json was changed since rvbench kept it"));
    CHECK_THAT(limits({"activate", "v1", "--by", "A. Sato"}).err,
               Contains("v1 was changed since it was approved"));
  }
}

}  // namespace rvbench::bench
