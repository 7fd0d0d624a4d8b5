#include "bench/factory/result_message.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/factory/file_uri.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/factory/judged_runs.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using rvbench::test::judged_run;
using rvbench::test::ScratchFolder;

namespace {

nlohmann::json told(const ScratchFolder& root, const std::filesystem::path& folder,
                    const std::string& step = "") {
  const auto message = result_message(root.path(), folder, step);
  REQUIRE(message);
  return nlohmann::json::parse(message.value().payload);
}

Judgement ended(Outcome outcome, ErrorKind kind = ErrorKind::none) {
  Judgement judgement = test::passed_run();
  judgement.ending = {outcome, kind, "as it ended"};
  return judgement;
}

}  // namespace

// Names: OPC 40001-101, tables 27 and 29; nothing else may stand among them.
TEST_CASE("a result is told in the fields of OPC 40001-101", "[factory][message]") {
  const ScratchFolder root;
  const auto folder = judged_run(root.path(), test::failed_run(), "A-17");
  const nlohmann::json result = told(root, folder, "EOL-20");
  const nlohmann::json& meta = result.at("ResultMetaData");
  const std::vector<std::string> known{"ResultId",
                                       "HasTransferableDataOnFile",
                                       "IsPartial",
                                       "IsSimulated",
                                       "ResultState",
                                       "StepId",
                                       "PartId",
                                       "ExternalRecipeId",
                                       "InternalRecipeId",
                                       "ProductId",
                                       "ExternalConfigurationId",
                                       "InternalConfigurationId",
                                       "JobId",
                                       "CreationTime",
                                       "ProcessingTimes",
                                       "ResultUri",
                                       "ResultEvaluation",
                                       "ResultEvaluationCode",
                                       "ResultEvaluationDetails",
                                       "FileFormat"};
  for (const auto& [name, value] : meta.items()) {
    INFO(name);
    CHECK(std::ranges::count(known, name) == 1);
    CHECK_FALSE(value.is_null());
  }
  CHECK(meta.at("ResultId").get<std::string>().size() == 32);
  CHECK(meta.at("PartId") == "A-17");
  CHECK(meta.at("StepId") == "EOL-20");
  CHECK(meta.at("JobId") == "A-17/20260102T030405Z");
  CHECK(meta.at("ExternalRecipeId") == "quick");
  CHECK(meta.at("InternalRecipeId") == "sha256:" + sha256_of_text(R"({"name": "quick"})"));
  CHECK(meta.at("ProductId") == "RV-20E");
  CHECK(meta.at("IsSimulated") == true);
  CHECK(meta.at("IsPartial") == false);
  CHECK(meta.at("HasTransferableDataOnFile") == false);
  CHECK(meta.at("ResultState") == 1);
  CHECK(meta.at("ResultEvaluation") == 2);
  CHECK(meta.at("ResultEvaluationCode") == 10);
  CHECK(meta.at("ResultEvaluationDetails").at("Text") == "input_shaft: misalignment");
  CHECK(meta.at("ProcessingTimes").at("StartTime") == "2026-01-02T03:04:05Z");
  CHECK(meta.at("ProcessingTimes").at("EndTime") == "2026-01-02T03:06:11Z");
  CHECK(meta.at("CreationTime") == "2026-01-02T03:06:11Z");  // whenever its files were copied
  CHECK(meta.at("ResultUri") == nlohmann::json::array({file_uri(folder / "verdict.json")}));
}

TEST_CASE("the content is verdict, findings and indicators of verdict.json", "[factory][message]") {
  const ScratchFolder root;
  const auto folder = judged_run(root.path(), test::failed_run(), "A17");
  const auto verdict = nlohmann::json::parse(read_file(folder / "verdict.json").value());
  const nlohmann::json result = told(root, folder);
  CHECK_FALSE(result.at("ResultMetaData").contains("StepId"));
  REQUIRE(result.at("ResultContent").size() == 1);
  const nlohmann::json& content = result.at("ResultContent").front();
  CHECK(content.at("verdict") == "FAIL");
  CHECK(content.at("findings") == verdict.at("findings"));
  CHECK(content.at("limits") == verdict.at("limits"));
  REQUIRE(content.at("points").size() == 2);
  const nlohmann::json& point = content.at("points").front();
  CHECK(point.at("indicators") == verdict.at("points").front().at("indicators"));
  const nlohmann::json& channel = verdict.at("points").front().at("channels").front();
  CHECK(point.at("channels").front().at("indicators") == channel.at("indicators"));
  CHECK_FALSE(point.contains("scores"));
}

TEST_CASE("each verdict has its evaluation and its state", "[factory][message]") {
  struct Case {
    Judgement judgement;
    int evaluation, state, code;
  };
  const std::vector<Case> cases{{ended(Outcome::pass), 1, 1, 0},
                                {ended(Outcome::fail), 2, 1, 10},
                                {ended(Outcome::invalid), 3, 1, 20},
                                {ended(Outcome::error, ErrorKind::safety_trip), 0, 4, 40},
                                {ended(Outcome::aborted), 0, 3, 50}};
  const ScratchFolder root;
  for (const Case& one : cases) {
    const auto meta =
        told(root, judged_run(root.path(), one.judgement, "A17")).at("ResultMetaData");
    INFO(meta.dump());
    CHECK(meta.at("ResultEvaluation") == one.evaluation);
    CHECK(meta.at("ResultState") == one.state);
    CHECK(meta.at("ResultEvaluationCode") == one.code);
  }
}

TEST_CASE("a ResultId stays as long as the verdict does", "[factory][message]") {
  const ScratchFolder root;
  const auto folder = judged_run(root.path(), ended(Outcome::aborted), "A17");
  const auto same_verdict = judged_run(root.path(), ended(Outcome::aborted), "A17");
  const std::string id = result_id_of(root.path(), folder);
  write_file(folder / "report.html", "made later");
  write_sums(folder);
  CHECK(result_id_of(root.path(), folder) == id);
  CHECK(result_id_of(root.path(), same_verdict) != id);
  SECTION("a run that is resumed comes to another result") {
    write_file(folder / "verdict.json", judgement_to_json(ended(Outcome::pass)));
    write_sums(folder);
    CHECK(result_id_of(root.path(), folder) != id);
  }
  SECTION("a run that is at work has none") {
    remove_sums(folder);
    CHECK(result_id_of(root.path(), folder).empty());
  }
}

TEST_CASE("a verdict that is damaged or was changed is not told", "[factory][message]") {
  const ScratchFolder root;
  const auto folder = judged_run(root.path(), test::failed_run(), "A17");
  const auto refused = [&] {
    const auto message = result_message(root.path(), folder, "");
    REQUIRE_FALSE(message);
    return message.error().where;
  };
  std::string text = read_file(folder / "verdict.json").value();
  text.replace(text.find("FAIL"), 4, "PASS");
  write_file(folder / "verdict.json", text);
  CHECK(refused() == "its verdict.json does not match its hash");
  write_file(folder / "verdict.json", "{");
  CHECK(refused() == "its verdict.json is damaged");
}

TEST_CASE("what goes out says whether it may be there already", "[factory][message]") {
  OutboxEntry due{.result_id = "1", .folder = "A/1", .payload = R"({"ResultContent": []})"};
  CHECK(nlohmann::json::parse(payload_to_send(due)).at("PossibleDuplicate") == false);
  due.sends = 1;
  CHECK(nlohmann::json::parse(payload_to_send(due)).at("PossibleDuplicate") == true);
}

TEST_CASE("a file's URI names its computer and escapes what is no part of one",
          "[factory][message]") {
  const std::string uri = file_uri("/srv/runs/A 17%/ä.json");
  CHECK(uri.starts_with("file://"));
  CHECK(uri.ends_with("/srv/runs/A%2017%25/%C3%A4.json"));
}

}  // namespace rvbench::bench
