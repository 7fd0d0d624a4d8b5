#include <catch2/catch.hpp>
#include <filesystem>

#include "bench/find_plan.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_results.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "sequences/plan.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

// A run folder that has come to its end.
std::filesystem::path leave_run(const std::filesystem::path& folder) {
  write_file(folder / "plan.json", sequences::plan_to_json(std::get<0>(find_plan("quick"))));
  write_file(folder / "kinematics.json", kinematics_text("rv20e"));
  write_file(folder / "verdict.json", judgement_to_json(test::passed_run()));
  write_sums(folder);
  return folder;
}

void change(const std::filesystem::path& file) {
  write_file(file, read_file(file).value() + "% changed\n");
}

}  // namespace

TEST_CASE("a report on paper is one of the run's files, and a changed one is found",
          "[bench][pdf]") {
  const ScratchFolder run;
  const auto folder = leave_run(run.path());
  const CommandAnswer made = rvbench({"report", folder.string(), "--pdf"});
  INFO(made.err);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.out, Contains("report.pdf"));
  const std::string paper = read_file(folder / "report.pdf").value();
  CHECK(paper.starts_with("%PDF-"));
  CHECK_THAT(read_file(folder / "SHA256SUMS").value(),
             Contains(sha256_of_text(paper) + "  report.pdf"));
  CHECK(rvbench({"check", folder.string()}).code == 0);

  change(folder / "report.pdf");
  const CommandAnswer checked = rvbench({"check", folder.string()});
  CHECK(checked.code == 3);
  CHECK_THAT(checked.err, Contains("report.pdf: does not match its hash"));
  SECTION("the page of the browser made anew does not bless it") {
    const CommandAnswer answer = rvbench({"report", folder.string()});
    CHECK(answer.code == 3);
    CHECK_THAT(answer.err, Contains("report.pdf: does not match its hash"));
    CHECK(rvbench({"check", folder.string()}).code == 3);
  }
  SECTION("it is made anew with the same bytes") {
    CHECK(rvbench({"report", folder.string(), "--pdf"}).code == 0);
    CHECK(read_file(folder / "report.pdf").value() == paper);
    CHECK(rvbench({"check", folder.string()}).code == 0);
  }
  SECTION("of a verdict that was changed no report is made") {
    change(folder / "verdict.json");
    const CommandAnswer answer = rvbench({"report", folder.string(), "--pdf"});
    CHECK(answer.code == 3);
    CHECK_THAT(answer.err, Contains("verdict.json"));
  }
}

TEST_CASE("reports state the hash of the run's sums, whoever made reports before", "[bench][pdf]") {
  const ScratchFolder run;
  const auto folder = leave_run(run.path());
  const std::string sums = read_file(folder / "SHA256SUMS").value();
  REQUIRE_THAT(sums, !Contains("report."));
  const auto stated = [&] {
    const auto input = report_input(folder, test::passed_run(), {});
    CHECK(input.hashes.back().first == sums_in_report);
    return input.hashes.back().second;
  };
  CHECK(stated() == sha256_of_text(sums));
  REQUIRE(rvbench({"report", folder.string(), "--pdf"}).code == 0);
  REQUIRE_THAT(read_file(folder / "SHA256SUMS").value(),
               Contains("  report.pdf") && Contains("  report.html"));
  CHECK(stated() == sha256_of_text(sums));
}

TEST_CASE("a copy of the report on paper goes where --out says", "[bench][pdf]") {
  const ScratchFolder run, desk;
  const auto folder = leave_run(run.path());
  const std::string copy = (desk / "A18.pdf").string();
  REQUIRE(rvbench({"report", folder.string(), "--pdf", "--out", copy}).code == 0);
  CHECK(read_file(copy).value() == read_file(folder / "report.pdf").value());

  const CommandAnswer again = rvbench({"report", folder.string(), "--pdf", "--out", copy});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("A18.pdf: exists; --force replaces it"));
  CHECK(rvbench({"report", folder.string(), "--pdf", "--out", copy, "--force"}).code == 0);

  const CommandAnswer alone = rvbench({"report", folder.string(), "--out", copy});
  CHECK(alone.code == 2);
  CHECK_THAT(alone.err, Contains("add --pdf"));
  const CommandAnswer nowhere =
      rvbench({"report", folder.string(), "--pdf", "--out", (desk / "no/A18.pdf").string()});
  CHECK(nowhere.code == 2);
  CHECK_THAT(nowhere.err, Contains("no/A18.pdf: No such file or directory"));
  CHECK(rvbench({"check", folder.string()}).code == 0);  // left as it was
}

TEST_CASE("no copy of a report takes the place of a file of a run", "[bench][pdf]") {
  const ScratchFolder run, other;
  const auto folder = leave_run(run.path());
  leave_run(other.path());
  const std::string verdict = read_file(other / "verdict.json").value();
  for (const auto& place : {folder / "verdict.json", other / "verdict.json", other / "new.pdf"}) {
    const CommandAnswer answer =
        rvbench({"report", folder.string(), "--pdf", "--out", place.string(), "--force"});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("is a run folder"));
  }
  CHECK(read_file(other / "verdict.json").value() == verdict);
  CHECK_FALSE(std::filesystem::exists(other / "new.pdf"));
  const ScratchFolder runs;
  write_file(runs / "ledger.jsonl", "");
  for (const auto& place : {runs / "ledger.jsonl", runs / "limits" / "new.json"}) {
    const CommandAnswer answer =
        rvbench({"report", folder.string(), "--pdf", "--out", place.string(), "--force"});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("is a folder of runs"));
  }
  CHECK(rvbench({"report", folder.string(), "--pdf", "--out", "/dev/null", "--force"}).code == 2);
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("a report renews its own sums alone", "[bench][pdf]") {
  const ScratchFolder run;
  const auto folder = leave_run(run.path());
  REQUIRE(rvbench({"report", folder.string()}).code == 0);
  const std::string before = read_file(folder / "SHA256SUMS").value();
  change(folder / "plan.json");
  renew_sums(folder, {"report.html"});
  CHECK(read_file(folder / "SHA256SUMS").value() == before);
  CHECK(verify_sums(folder) == std::vector<std::string>{"plan.json: does not match its hash"});
}

TEST_CASE("a new verdict takes the old report on paper away", "[bench][pdf]") {
  const ScratchFolder run;
  const auto folder = leave_run(run.path());
  REQUIRE(rvbench({"report", folder.string(), "--pdf"}).code == 0);
  CHECK(write_results(folder, test::failed_run(), {}, true).empty());
  CHECK_FALSE(std::filesystem::exists(folder / "report.pdf"));
  CHECK(std::filesystem::exists(folder / "report.html"));
  CHECK(verify_sums(folder).empty());
}

}  // namespace rvbench::bench
