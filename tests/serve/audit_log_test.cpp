#include "bench/serve/audit_log.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::istringstream in(read_file(file).value_or(""));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void write_lines(const std::filesystem::path& file, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  write_file(file, text);
}

void add_five(const std::filesystem::path& file) {
  AuditLog log(file);
  for (int i = 0; i < 5; ++i) {
    REQUIRE(log.add({"anna", "127.0.0.1", "scan", R"({"text":"A)" + std::to_string(i) + "\"}"}));
  }
}

}  // namespace

TEST_CASE("an audit log carries who did what from where, hash upon hash", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl";
  add_five(file);
  const auto lines = lines_of(file);
  REQUIRE(lines.size() == 5);
  const auto first = nlohmann::json::parse(lines[0]), second = nlohmann::json::parse(lines[1]);
  CHECK(first.at("user") == "anna");
  CHECK(first.at("address") == "127.0.0.1");
  CHECK(first.at("action") == "scan");
  CHECK(first.at("detail").at("text") == "A0");
  CHECK(first.at("previous") == std::string(64, '0'));
  CHECK(second.at("previous") == first.at("hash"));
  // As sha256sum says it of the line up to its hash.
  CHECK(first.at("hash") == sha256_of_text(lines[0].substr(0, lines[0].find(",\"hash\""))));

  const auto answer = test::rvbench({"check", file.string()});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("5 lines") && Contains(nlohmann::json::parse(lines[4])["hash"]));

  add_five(file);  // by another process, later
  CHECK(check_audit(file)->broken_line == 0);
  CHECK(check_audit(file)->lines == 10);
}

TEST_CASE("whatever is done to a line of an audit log, check names the first that it broke",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl";
  add_five(file);
  auto lines = lines_of(file);
  std::size_t broken = 0;
  std::string fault;
  SECTION("changed") {
    lines[2].replace(lines[2].find("anna"), 4, "otto");
    broken = 3;
    fault = "was changed";
  }
  SECTION("changed, and its own hash made to fit") {
    lines[2].replace(lines[2].find("anna"), 4, "otto");
    const std::string text = lines[2].substr(0, lines[2].find(",\"hash\""));
    lines[2] = text + ",\"hash\":\"" + sha256_of_text(text) + "\"}";
    broken = 4;
    fault = "does not follow";
  }
  SECTION("taken out") {
    lines.erase(lines.begin() + 1);
    broken = 2;
    fault = "does not follow";
  }
  SECTION("the first taken out") {
    lines.erase(lines.begin());
    broken = 1;
    fault = "does not follow";
  }
  SECTION("moved") {
    std::swap(lines[3], lines[4]);
    broken = 4;
    fault = "does not follow";
  }
  SECTION("put in") {
    lines.insert(lines.begin() + 2, lines[0]);
    broken = 3;
    fault = "does not follow";
  }
  SECTION("something else") {
    lines[4] = "{}";
    broken = 5;
    fault = "is no line of such a log";
  }
  write_lines(file, lines);
  const auto answer = test::rvbench({"check", file.string()});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err,
             Contains("audit.jsonl:" + std::to_string(broken) + ":") && Contains(fault));
}

TEST_CASE("a line that a power failure cut short is told, and taken out when the log goes on",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl";
  add_five(file);
  const std::string text = read_file(file).value();
  const std::string whole = text.substr(0, text.rfind('\n', text.size() - 2) + 1);
  const std::string half = text.substr(whole.size(), 30);
  write_file(file, whole + half);
  CHECK(check_audit(file)->broken_line == 5);
  CHECK_THAT(check_audit(file)->fault, Contains("was cut short, as by a power failure"));
  CHECK(test::rvbench({"check", file.string()}).code == 3);
  add_five(file);
  CHECK(check_audit(file)->lines == 10);  // four, what was cut short, and five
  CHECK(check_audit(file)->broken_line == 0);
  const auto told = nlohmann::json::parse(lines_of(file)[4]);
  CHECK(told.at("action") == "cut short");
  CHECK(told.at("detail").at("text") == half);
  CHECK(told.at("previous") == nlohmann::json::parse(lines_of(file)[3]).at("hash"));
  CHECK(test::rvbench({"check", file.string()}).code == 0);
}

TEST_CASE("a last line that lacks only its end is a line", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl";
  add_five(file);
  const std::string text = read_file(file).value();
  write_file(file, text.substr(0, text.size() - 1));
  CHECK(check_audit(file)->broken_line == 0);
  add_five(file);
  CHECK(check_audit(file)->lines == 10);
  CHECK(check_audit(file)->broken_line == 0);
}

TEST_CASE("what was changed before a cut line stays told when the log goes on", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl";
  add_five(file);
  std::string text = read_file(file).value();
  text.replace(text.find("A2"), 2, "B2");
  write_file(file, text + R"({"half)");
  add_five(file);
  CHECK(check_audit(file)->broken_line == 3);
  CHECK_THAT(check_audit(file)->fault, Contains("was changed"));
}

TEST_CASE("a log that was moved or deleted takes nothing, until it is back", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl", elsewhere = scratch / "elsewhere.jsonl";
  const AuditEntry entry{"anna", "127.0.0.1", "scan", ""};
  AuditLog log(file);
  CHECK(log.is_new());
  REQUIRE(log.add(entry));
  std::filesystem::rename(file, elsewhere);
  const Status gone = log.add(entry);
  REQUIRE_FALSE(gone);
  CHECK(gone.error().where == file.string() + " is gone, or another file stands in its place");
  std::filesystem::copy_file(elsewhere, file);
  CHECK_FALSE(log.add(entry));  // a copy, however alike
  CHECK(check_audit(file)->lines == 1);
  CHECK(check_audit(elsewhere)->lines == 1);
  std::filesystem::rename(elsewhere, file);
  CHECK(log.add(entry));
  CHECK(check_audit(file)->lines == 2);
  CHECK(check_audit(file)->broken_line == 0);
  CHECK_FALSE(AuditLog(file).is_new());
}

TEST_CASE("a log that was cut short in its place takes nothing, until it is opened anew",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto file = scratch / "audit.jsonl";
  const AuditEntry entry{"anna", "127.0.0.1", "scan", ""};
  {
    AuditLog log(file);
    REQUIRE(log.add(entry));
    const auto one_line = std::filesystem::file_size(file);
    REQUIRE(log.add(entry));
    std::filesystem::resize_file(file, one_line);
    const Status cut = log.add(entry);
    REQUIRE_FALSE(cut);
    CHECK_THAT(cut.error().where, Contains("was changed by another hand"));
  }
  CHECK(AuditLog(file).add(entry));
  CHECK(check_audit(file)->lines == 2);
  CHECK(check_audit(file)->broken_line == 0);
}

TEST_CASE("no audit log is none, and one that cannot be written says so", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  CHECK_FALSE(check_audit(scratch / "none.jsonl"));
  CHECK_FALSE(is_audit_log(scratch / "none.jsonl"));
  AuditLog log(scratch / "no folder" / "audit.jsonl");
  const Status added = log.add({"anna", "", "scan", ""});
  REQUIRE_FALSE(added);
  CHECK_THAT(describe(added.error()), Contains("audit.jsonl"));
  CHECK(log.last(10) == "[]");
}

}  // namespace rvbench::bench
