#include <sqlite3.h>

#include <catch2/catch.hpp>

#include "bench/result_database.hpp"
#include "bench/results/schema.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

namespace {

// What another program does with the file.
void by_hand(const ScratchFolder& root, const std::string& sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open((root / "results.db").c_str(), &database) == SQLITE_OK);
  CHECK(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

std::int64_t number_in(const ScratchFolder& root, const char* sql) {
  const auto file = SqliteFile::open(root / "results.db", "results.db");
  REQUIRE(file);
  SqlStatement query(file.value(), sql);
  return query.next() ? query.integer(0) : -1;
}

// The table as the first version of rvbench made it, with one run.
constexpr const char* first_version = R"(
  CREATE TABLE runs (
    folder TEXT PRIMARY KEY, serial TEXT NOT NULL, started_utc TEXT NOT NULL, plan TEXT NOT NULL,
    verdict TEXT NOT NULL, error_kind TEXT NOT NULL, reason TEXT NOT NULL, software TEXT NOT NULL);
  CREATE INDEX runs_of_serial ON runs (serial, started_utc);
  INSERT INTO runs VALUES ('A17/20260102T030405Z', 'A17', '20260102T030405Z', 'quick', 'FAIL',
    'none', 'as it was told', '0.1.0');)";

// Its folder, as the run left it.
void make_folder(const ScratchFolder& root) {
  const auto folder = create_run_folder(root.path(), "A17", "20260102T030405Z");
  Judgement judgement = test::failed_run();
  judgement.facts.serial = "A17";
  write_file(folder / "verdict.json", judgement_to_json(judgement));
  write_sums(folder);
}

}  // namespace

TEST_CASE("a table of the first version keeps its runs, and their folders tell the rest",
          "[bench][results]") {
  const ScratchFolder root;
  by_hand(root, first_version);
  {
    auto opened = ResultDatabase::open(root.path());
    REQUIRE(opened);
    ResultDatabase database = std::move(opened).value();
    REQUIRE(database.runs().value().size() == 1);
    CHECK(database.runs().value()[0].reason == "as it was told");
    CHECK(database.catch_up().value() == 0);  // its folder is gone: what was told stays
    make_folder(root);
    CHECK(database.catch_up().value() == 1);
    CHECK(database.catch_up().value() == 0);
  }
  CHECK(number_in(root, "PRAGMA user_version") == schema_version);
  CHECK(number_in(root, "SELECT count(*) FROM points") == 2);
  // Of failed_run(): three of the channel, one of the shaft.
  CHECK(number_in(root, "SELECT count(*) FROM indicators") == 4);
  CHECK(number_in(root, "SELECT count(*) FROM findings") == 2);
  CHECK(number_in(root, "SELECT count(*) FROM judgements") == 1);
  CHECK(number_in(root, "SELECT count(*) FROM units WHERE machine = 'RV-20E'") == 1);
}

TEST_CASE("a table of the second version is told its extremes from its values",
          "[bench][results]") {
  const ScratchFolder root;
  Judgement judgement = test::failed_run();
  auto& channels = judgement.points[0].examination.channels;
  channels.resize(2, channels.front());
  channels[1].name = "accel_1y";
  channels[1].indicators[0].value = 4.5;  // kurtosis, 3.1 in the other
  const auto worst = [&](bool least) {
    const auto database = ResultDatabase::open(root.path());
    REQUIRE(database);
    return database.value().series({.measure = "kurtosis", .least = least}).value();
  };
  {
    auto opened = ResultDatabase::open(root.path());
    REQUIRE(opened);
    ResultDatabase database = std::move(opened).value();
    REQUIRE(
        database.enter(row_of(root.path(), root / "A17/20260102T030405Z", judgement), judgement));
  }
  by_hand(root, "DROP TABLE extremes; DROP TABLE audit; PRAGMA user_version = 3;");
  for (const char* column : {"number", "rig_kind", "station", "verdict_sha256"}) {
    by_hand(root, std::string("ALTER TABLE runs DROP COLUMN ") + column);
  }
  REQUIRE(worst(false).size() == 1);
  CHECK(worst(false)[0].value == 4.5);
  CHECK(worst(false)[0].channel == "accel_1y");
  CHECK(worst(false)[0].point == 0);
  CHECK(worst(true)[0].value == 3.1);
  CHECK(worst(true)[0].channel == "accel_1x");
  CHECK(number_in(root, "PRAGMA user_version") == schema_version);
}

TEST_CASE("a table of a newer version is refused by its number, and left as it is",
          "[bench][results]") {
  const ScratchFolder root;
  by_hand(root, "PRAGMA user_version = 99; CREATE TABLE runs (all_new TEXT);");
  const auto refused = ResultDatabase::open(root.path());
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().where,
             Contains("results.db is of version 99") && Contains("newer one"));
  CHECK(number_in(root, "PRAGMA user_version") == 99);
  CHECK(number_in(root, "SELECT count(*) FROM pragma_table_info('runs')") == 1);
}

TEST_CASE("a step that fails leaves the old tables whole", "[bench][results]") {
  const ScratchFolder root;
  by_hand(root, first_version);
  by_hand(root, "CREATE TABLE findings (in_the_way TEXT);");
  CHECK_FALSE(ResultDatabase::open(root.path()));
  CHECK(number_in(root, "PRAGMA user_version") == 0);
  CHECK(number_in(root, "SELECT count(*) FROM runs") == 1);
  CHECK(number_in(root, "SELECT count(*) FROM sqlite_master WHERE name = 'points'") == 0);
}

TEST_CASE("a run that is entered again has its values once", "[bench][results]") {
  const ScratchFolder root;
  auto opened = ResultDatabase::open(root.path());
  REQUIRE(opened);
  ResultDatabase database = std::move(opened).value();
  const Judgement judgement = test::failed_run();
  const RunRow row = row_of(root.path(), root / "A17/20260102T030405Z", judgement);
  REQUIRE(database.enter(row, judgement));
  REQUIRE(database.enter(row, test::passed_run()));
  CHECK(number_in(root, "SELECT count(*) FROM indicators") == 4);
  CHECK(number_in(root, "SELECT count(*) FROM extremes") == 4);
  CHECK(number_in(root, "SELECT count(*) FROM points") == 1);
  CHECK(database.runs_with_finding("input_shaft").value().empty());
}

}  // namespace rvbench::bench
