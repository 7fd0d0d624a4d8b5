#include "bench/results/audit_index.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/hash_chain.hpp"
#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/serve/audit_log.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

namespace {

// A station's log beside its results.
class ServedRuns {
 public:
  ServedRuns() { std::filesystem::create_directories(log().parent_path()); }

  std::filesystem::path log() const { return audit_log_of(root_.path()); }

  void act(const std::string& user, const std::string& action, const std::string& detail = "") {
    REQUIRE(AuditLog(log()).add({user, "127.0.0.1", action, detail}));
  }

  void enter() { REQUIRE(caught_up(ResultDatabase::open(root_.path()))); }

  void spoil_results() const { write_file(root_ / result_database_name, "no table"); }

  std::string asked(const char* sql) const {
    const auto file = SqliteFile::open(root_ / result_database_name, result_database_name);
    SqlStatement statement(file.value(), sql);
    return statement.next() ? statement.text(0) : "nothing";
  }

  test::CommandAnswer check() const { return test::rvbench({"check", log().string()}); }

 private:
  ScratchFolder root_;
};

}  // namespace

TEST_CASE("results.db tells who did what, of lines that came since, too", "[bench][results]") {
  ServedRuns runs;
  runs.enter();
  CHECK(runs.asked("SELECT count(*) FROM audit") == "0");
  runs.act("anna", "login");
  runs.act("anna", "start", R"({"serial":"A17"})");
  runs.enter();
  runs.act("bert", "stop");
  runs.enter();
  runs.enter();
  CHECK(runs.asked("SELECT group_concat(user || ' ' || action, ', ') FROM audit") ==
        "anna login, anna start, bert stop");
  CHECK(runs.asked("SELECT group_concat(line, ', ') FROM audit") == "1, 2, 3");
  CHECK(runs.check().code == 0);
}

TEST_CASE("lines that were taken from an audit log's end are told, and stay in results.db",
          "[bench][results]") {
  ServedRuns runs;
  for (const char* action : {"login", "start", "approve limits"}) runs.act("anna", action);
  runs.enter();
  const std::string whole = read_file(runs.log()).value();
  SECTION("the newest") {
    const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
    write_file(runs.log(), whole.substr(0, last));
    CHECK_THAT(runs.check().err, Contains("lines from 20") && Contains("(1)"));
  }
  SECTION("all of them, and another log begun") {
    std::filesystem::remove(runs.log());
    runs.act("bert", "login");
    CHECK_THAT(runs.check().err, Contains("(3)"));
    runs.enter();
    runs.act("bert", "start");
    runs.enter();
    CHECK(runs.asked("SELECT group_concat(line, ', ') FROM audit") == "1, 2, 3, 1, 2");
  }
  CHECK(runs.check().code == 3);
  CHECK(runs.asked("SELECT count(*) FROM audit WHERE action = 'approve limits'") == "1");
}

TEST_CASE("lines that were entered are not looked at again", "[bench][results]") {
  ServedRuns runs;
  runs.act("anna", "login");
  runs.enter();
  std::string text = read_file(runs.log()).value();
  const std::string first = text.substr(0, text.size() - 1);
  text.replace(text.find("anna"), 4, "bert");  // a second look at it would find that out
  text += chained_line({{"user", "anna"}, {"action", "start"}}, hash_of_line(first)) + "\n";
  write_file(runs.log(), text);
  runs.enter();
  CHECK(runs.asked("SELECT group_concat(user || ' ' || action, ', ') FROM audit") ==
        "anna login, anna start");
}

TEST_CASE("a log without results that can be read is not said to be whole", "[bench][results]") {
  ServedRuns runs;
  runs.act("anna", "login");
  runs.spoil_results();
  const auto checked = runs.check();
  CHECK(checked.code == 0);
  CHECK_THAT(checked.err, Contains("warning") && Contains("cannot be held against results.db"));
}

TEST_CASE("nothing is entered from the first line on that was changed", "[bench][results]") {
  ServedRuns runs;
  for (const char* action : {"login", "start", "stop"}) runs.act("anna", action);
  std::string text = read_file(runs.log()).value();
  text.replace(text.find("start"), 5, "clear");
  write_file(runs.log(), text);
  runs.enter();
  CHECK(runs.asked("SELECT count(*) FROM audit") == "1");
}

}  // namespace rvbench::bench
