#include "bench/result_database.hpp"

#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/results/unentered_runs.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using rvbench::test::ScratchFolder;

namespace {

ResultDatabase opened(const ScratchFolder& root) {
  auto database = ResultDatabase::open(root.path());
  REQUIRE(database);
  return std::move(database).value();
}

RunRow row_number(int number) {
  return {"A17/" + std::to_string(number),
          "A17",
          std::to_string(20260101 + number),
          "quick",
          "PASS",
          "none",
          "nothing above its limit",
          "0.1.0",
          number,
          "sim",
          "EOL 3",
          "5ea1"};
}

Status entered(ResultDatabase& database, const RunRow& row) {
  return database.enter(row, test::passed_run());
}

// A run folder with verdict and sums, as a run leaves it.
std::filesystem::path finished_run(const ScratchFolder& root, const std::string& serial) {
  const auto folder = create_run_folder(root.path(), serial, "20260102T030405Z");
  Judgement judgement = test::failed_run();
  judgement.facts.serial = serial;
  write_file(folder / "verdict.json", judgement_to_json(judgement));
  write_sums(folder);
  return folder;
}

// Another program that keeps the database to itself.
class Hog {
 public:
  explicit Hog(const ScratchFolder& root) {
    REQUIRE(sqlite3_open((root / "results.db").c_str(), &database_) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database_, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr) == SQLITE_OK);
  }
  ~Hog() { sqlite3_close(database_); }
  Hog(const Hog&) = delete;
  Hog& operator=(const Hog&) = delete;

 private:
  sqlite3* database_ = nullptr;
};

}  // namespace

TEST_CASE("runs that were entered are there, oldest first, and by unit", "[bench][results]") {
  const ScratchFolder root;
  {
    ResultDatabase database = opened(root);
    REQUIRE(entered(database, row_number(2)));
    REQUIRE(entered(database, row_number(1)));
    RunRow other = row_number(3);
    other.serial = "B'; DROP TABLE runs; --";
    other.folder = "B/3";
    REQUIRE(entered(database, other));
    RunRow again = row_number(2);
    again.verdict = "FAIL";
    REQUIRE(entered(database, again));
  }
  const ResultDatabase database = opened(root);
  const auto all = database.runs();
  REQUIRE(all);
  REQUIRE(all.value().size() == 3);
  CHECK(all.value()[0].folder == "A17/1");
  CHECK(all.value()[1].verdict == "FAIL");
  CHECK(all.value()[2].serial == "B'; DROP TABLE runs; --");
  CHECK(database.runs("A17").value().size() == 2);
  CHECK(database.runs("A18").value().empty());
}

TEST_CASE("a locked database is told, and what it misses is entered later", "[bench][results]") {
  const ScratchFolder root;
  ResultDatabase database = opened(root);
  const auto folder = finished_run(root, "A17");
  {
    const Hog hog(root);
    const Status refused = entered(database, row_number(1));
    REQUIRE_FALSE(refused);
    CHECK_THAT(refused.error().where, Catch::Contains("results.db cannot be written: database is "
                                                      "locked"));
  }
  const auto caught_up = database.catch_up();
  REQUIRE(caught_up);
  CHECK(caught_up.value() == 1);
  const auto rows = database.runs("A17");
  REQUIRE(rows.value().size() == 1);
  CHECK(root.path() / rows.value()[0].folder == folder);
  CHECK(rows.value()[0].verdict == "FAIL");
  CHECK(rows.value()[0].reason == "input_shaft: misalignment");
  CHECK(database.catch_up().value() == 0);
}

TEST_CASE("a run that was resumed to another verdict is entered anew", "[bench][results]") {
  const ScratchFolder root;
  ResultDatabase database = opened(root);
  const auto folder = finished_run(root, "A17");
  RunRow aborted = row_of(root.path(), folder, test::failed_run());
  aborted.verdict = "ABORTED";
  aborted.sha256 = "of another text";
  REQUIRE(entered(database, aborted));  // as it was before, and its second entry failed
  CHECK(database.catch_up().value() == 1);
  CHECK(database.runs().value().at(0).verdict == "FAIL");
  CHECK(database.catch_up().value() == 0);
}

TEST_CASE("a folder that cannot be looked into hinders no other", "[bench][results]") {
  const ScratchFolder root;
  finished_run(root, "A17");
  const auto odd = root / "B2" / "20260102T030405Z";
  std::filesystem::create_directories(odd);
  for (const char* name : {"plan.json", "SHA256SUMS"}) {
    std::filesystem::create_symlink(name, odd / name);  // a link to itself
  }
  CHECK_FALSE(newest_unfinished_run(root.path(), "B2"));
  const test::CommandAnswer all =
      test::rvbench({"history", "--out", root.path().string(), "--json"});
  CHECK(all.code == 0);
  CHECK(nlohmann::json::parse(all.out).at("runs").size() == 1);
}

TEST_CASE("a run whose results are still being written is not entered", "[bench][results]") {
  const ScratchFolder root;
  ResultDatabase database = opened(root);
  const auto folder = create_run_folder(root.path(), "A17", "20260102T030405Z");
  write_file(folder / "plan.json", R"({"name": "quick"})");
  CHECK(unfinished_runs(root.path()).at(0).reason == "not finished: cut short");
  write_file(folder / "verdict.json", judgement_to_json(test::failed_run()));
  CHECK_THAT(unfinished_runs(root.path()).at(0).reason,
             Catch::Matchers::Contains("has a verdict.json but no SHA256SUMS"));
  CHECK(database.catch_up().value() == 0);
  write_sums(folder);
  CHECK(database.catch_up().value() == 1);
}

TEST_CASE("a file that is no database is refused, and left as it is", "[bench][results]") {
  const ScratchFolder root;
  const std::string text(4096, 'x');
  std::ofstream(root / "results.db") << text;
  const auto database = ResultDatabase::open(root.path());
  REQUIRE_FALSE(database);
  CHECK_THAT(database.error().where, Catch::Contains("not a database"));
  CHECK(read_file(root / "results.db") == text);
}

#if !defined(__SANITIZE_THREAD__)  // whose forked children may not go on

TEST_CASE("kill -9 takes no entry back that was acknowledged", "[bench][results]") {
  for (const int entries : {1, 5, 20}) {
    const ScratchFolder root;
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
      auto database = ResultDatabase::open(root.path());
      for (int number = 0; database; ++number) {
        ResultDatabase& results = const_cast<ResultDatabase&>(database.value());
        if (!entered(results, row_number(number))) ::_exit(1);
        if (::write(ends[1], &number, sizeof number) != sizeof number) ::_exit(2);
      }
      ::_exit(3);
    }
    ::close(ends[1]);
    int acknowledged = -1;
    while (acknowledged < entries) {
      REQUIRE(::read(ends[0], &acknowledged, sizeof acknowledged) == sizeof acknowledged);
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    for (int more = 0; ::read(ends[0], &more, sizeof more) == sizeof more;) acknowledged = more;
    ::close(ends[0]);
    const auto rows = opened(root).runs();
    REQUIRE(rows);
    CHECK(static_cast<int>(rows.value().size()) > acknowledged);
  }
}

#endif

TEST_CASE("history tells every run of a folder, also those nobody entered", "[bench][results]") {
  const ScratchFolder root;
  finished_run(root, "A17");
  finished_run(root, "B2");
  const test::CommandAnswer all = test::rvbench({"history", "--out", root.path().string()});
  CHECK(all.code == 0);
  CHECK_THAT(all.out, Catch::Contains("2026-01-02 03:04:05  A17     quick  FAIL     input_shaft"));
  CHECK_THAT(all.out, Catch::Contains("B2"));
  const test::CommandAnswer one =
      test::rvbench({"history", "--out", root.path().string(), "--serial", "B2", "--json"});
  const auto runs = nlohmann::json::parse(one.out).at("runs");
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].at("serial") == "B2");
  CHECK(runs[0].at("verdict") == "FAIL");
  const test::CommandAnswer none =
      test::rvbench({"history", "--out", root.path().string(), "--serial", "C"});
  CHECK_THAT(none.out, Catch::Contains("no such run in "));
  const test::CommandAnswer absent = test::rvbench({"history", "--out", (root / "no").string()});
  CHECK(absent.code == 2);
}

TEST_CASE("history tells runs without a result, in rows that hold", "[bench][results]") {
  const ScratchFolder root;
  finished_run(root, "A17");
  const std::string odd = "A\n17\x1b[31m" + std::string(200, 'x');
  for (const std::string& serial : {odd, std::string("results.db")}) {
    const auto place = begin_run(root.path(), serial, {{"plan.json", R"({"name": "mine"})"}});
    CHECK(read_run_begin(place.folder).serial == serial);
  }
  const test::CommandAnswer all = test::rvbench({"history", "--out", root.path().string()});
  CHECK(all.code == 0);
  CHECK(std::count(all.out.begin(), all.out.end(), '\n') == 4);
  CHECK_THAT(all.out, Catch::Contains("A?17?[31m" + std::string(54, 'x') +
                                      "…  mine   -        not finished"));
  CHECK_THAT(all.out, Catch::Contains("  results.db "));
  CHECK(all.out.find('\x1b') == std::string::npos);
  const test::CommandAnswer listed =
      test::rvbench({"history", "--out", root.path().string(), "--json"});
  const auto runs = nlohmann::json::parse(listed.out).at("runs");
  const auto one =
      std::ranges::find_if(runs, [&](const auto& run) { return run["serial"] == odd; });
  REQUIRE(one != runs.end());
  CHECK(one->at("verdict").is_null());
  CHECK_THAT(one->at("reason").get<std::string>(), Catch::Contains("not finished"));
}

TEST_CASE("a run whose verdict is damaged is told as such, unless it has been entered",
          "[bench][results]") {
  const ScratchFolder root;
  const auto folder = finished_run(root, "A17");
  write_file(folder / "plan.json", R"({"name": "mine"})");
  const std::vector<std::string> words{"history", "--out", root.path().string()};
  const auto told = [&] { return test::rvbench(words).out; };
  SECTION("before anybody entered it") {
    write_file(folder / "verdict.json", "{");
    CHECK_THAT(told(), Catch::Contains("A17     mine  -        its verdict.json is damaged"));
  }
  SECTION("afterwards") {
    CHECK_THAT(told(), Catch::Contains("A17     quick  FAIL"));
    write_file(folder / "verdict.json", "{");
    CHECK_THAT(told(), Catch::Contains("A17     quick  FAIL") && !Catch::Contains("damaged"));
  }
}

TEST_CASE("where the table cannot be used, history tells the runs from their folders",
          "[bench][results]") {
  const ScratchFolder root;
  finished_run(root, "A17");
  std::optional<Hog> hog;
  std::string why;
  SECTION("it is locked") {
    { const ResultDatabase made = opened(root); }
    hog.emplace(root);
    why = "database is locked";
  }
  SECTION("it is no database") {
    write_file(root / "results.db", std::string(4096, 'x'));
    why = "not a database";
  }
  SECTION("it is a folder") {
    std::filesystem::create_directory(root / "results.db");
    why = "unable to open database file";
  }
  const test::CommandAnswer answer = test::rvbench({"history", "--out", root.path().string()});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.err, Catch::Contains(why));
  CHECK_THAT(answer.out, Catch::Contains("A17     quick  FAIL"));
}

}  // namespace rvbench::bench
