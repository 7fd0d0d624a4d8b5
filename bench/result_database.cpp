#include "bench/result_database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

constexpr int busy_timeout_ms = 2000;

// Without WAL a reader would lock a writer out; FULL syncs the log at each commit.
constexpr const char* schema = R"sql(
  PRAGMA journal_mode = WAL;
  PRAGMA synchronous = FULL;
  CREATE TABLE IF NOT EXISTS runs (
    folder TEXT PRIMARY KEY, serial TEXT NOT NULL, started_utc TEXT NOT NULL, plan TEXT NOT NULL,
    verdict TEXT NOT NULL, error_kind TEXT NOT NULL, reason TEXT NOT NULL, software TEXT NOT NULL);
  CREATE INDEX IF NOT EXISTS runs_of_serial ON runs (serial, started_utc);
)sql";

// The columns, in the order of the statements below.
constexpr std::string RunRow::*columns[] = {&RunRow::folder, &RunRow::serial,  &RunRow::started_utc,
                                            &RunRow::plan,   &RunRow::verdict, &RunRow::error_kind,
                                            &RunRow::reason, &RunRow::software};
constexpr const char* put = "INSERT OR REPLACE INTO runs VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)";
constexpr const char* get =
    "SELECT folder, serial, started_utc, plan, verdict, error_kind, reason, software FROM runs "
    "WHERE ?1 = '' OR serial = ?1 ORDER BY started_utc, folder";

struct Finalize {
  void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

Statement prepare(sqlite3* database, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
  return Statement(statement);
}

void bind(const Statement& statement, int at, const std::string& text) {
  sqlite3_bind_text(statement.get(), at, text.data(), static_cast<int>(text.size()),
                    SQLITE_TRANSIENT);
}

bool may_be_resumed(const RunRow& row) {
  return row.verdict == to_string(Outcome::aborted) || row.verdict == to_string(Outcome::error);
}

std::optional<Judgement> verdict_in(const std::filesystem::path& folder) {
  return judgement_from_json(read_file(folder / "verdict.json").value_or(""));
}

// Folders two levels below, in no order: <serial>/<time>.
std::vector<std::filesystem::path> run_folders(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> folders;
  std::error_code error;  // what cannot be read is no run
  using Entries = std::filesystem::directory_iterator;
  for (Entries serial(root, error), end; !error && serial != end; serial.increment(error)) {
    std::error_code unreadable;
    for (Entries run(serial->path(), unreadable); !unreadable && run != end;
         run.increment(unreadable)) {
      std::error_code unknown;
      if (run->is_directory(unknown)) folders.push_back(run->path());
    }
  }
  return folders;
}

bool has_plan(const std::filesystem::path& folder) {
  std::error_code unknown;
  return std::filesystem::exists(folder / "plan.json", unknown);
}

// Of what the run recorded when it began.
RunRow row_without_result(const std::filesystem::path& root, const std::filesystem::path& folder,
                          const std::string& reason) {
  const RunBegin begin = read_run_begin(folder);
  const auto plan =
      nlohmann::json::parse(read_file(folder / "plan.json").value_or(""), nullptr, false);
  const bool is_named = plan.is_object() && plan.contains("name") && plan["name"].is_string();
  return {.folder = folder.lexically_relative(root).string(),
          .serial = begin.serial,
          .started_utc = begin.started_utc,
          .plan = is_named ? plan["name"].get<std::string>() : "",
          .verdict = "",
          .error_kind = "",
          .reason = reason,
          .software = ""};
}

}  // namespace

void ResultDatabase::Close::operator()(sqlite3* database) const noexcept {
  sqlite3_close(database);
}

ResultDatabase::ResultDatabase(std::filesystem::path root, std::unique_ptr<sqlite3, Close> database)
    : root_(std::move(root)), database_(std::move(database)) {}

Result<ResultDatabase> ResultDatabase::open(const std::filesystem::path& root) {
  return open_at(root, root / result_database_name);
}

Result<ResultDatabase> ResultDatabase::in_memory(const std::filesystem::path& root) {
  return open_at(root, ":memory:");
}

Result<ResultDatabase> ResultDatabase::open_at(const std::filesystem::path& root,
                                               const std::filesystem::path& file) {
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  ResultDatabase database(root, std::unique_ptr<sqlite3, Close>(opened));
  if (code != SQLITE_OK) return database.failure("cannot be opened");
  sqlite3_busy_timeout(opened, busy_timeout_ms);
  if (const Status made = database.execute(schema); !made) return made.error();
  return database;
}

Status ResultDatabase::enter(const RunRow& row) {
  const Statement statement = prepare(database_.get(), put);
  if (!statement) return failure("cannot be written");
  int at = 0;
  for (const auto column : columns) bind(statement, ++at, row.*column);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) return failure("cannot be written");
  return Done{};
}

Result<int> ResultDatabase::catch_up() {
  const auto known = runs();
  if (!known) return known.error();
  std::map<std::string, RunRow> entered;
  for (const RunRow& row : known.value()) entered.emplace(row.folder, row);
  int missing = 0;
  for (const std::filesystem::path& folder : run_folders(root_)) {
    const auto old = entered.find(folder.lexically_relative(root_).string());
    if (old != entered.end() && !may_be_resumed(old->second)) continue;
    if (!has_sums(folder)) continue;  // written last: the verdict is still being written
    const auto judgement = verdict_in(folder);
    if (!judgement) continue;
    const RunRow row = row_of(root_, folder, *judgement);
    if (old != entered.end() && row == old->second) continue;
    if (const Status done = enter(row); !done) return done.error();
    ++missing;
  }
  return missing;
}

Result<std::vector<RunRow>> ResultDatabase::runs(const std::string& serial) const {
  const Statement statement = prepare(database_.get(), get);
  if (!statement) return failure("cannot be read");
  bind(statement, 1, serial);
  std::vector<RunRow> rows;
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(statement.get())) == SQLITE_ROW) {
    RunRow& row = rows.emplace_back();
    int at = 0;
    for (const auto column : columns) {
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement.get(), at));
      row.*column = text == nullptr ? "" : text;
      ++at;
    }
  }
  if (code != SQLITE_DONE) return failure("cannot be read");
  return rows;
}

Status ResultDatabase::execute(const char* sql) {
  if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK) return Done{};
  return failure("cannot be used");
}

IoError ResultDatabase::failure(const std::string& what) const {
  return {IoErrc::refused, fmt::format("{} {}: {}", (root_ / result_database_name).string(), what,
                                       sqlite3_errmsg(database_.get()))};
}

std::vector<RunRow> unfinished_runs(const std::filesystem::path& root) {
  std::vector<RunRow> rows;
  for (const std::filesystem::path& folder : run_folders(root)) {
    if (has_sums(folder) || !has_plan(folder)) continue;
    rows.push_back(row_without_result(root, folder, "not finished: still at work, or cut short"));
  }
  return rows;
}

std::vector<RunRow> damaged_runs(const std::filesystem::path& root,
                                 const std::vector<RunRow>& entered) {
  std::set<std::string> known;
  for (const RunRow& row : entered) known.insert(row.folder);
  std::vector<RunRow> rows;
  for (const std::filesystem::path& folder : run_folders(root)) {
    if (known.contains(folder.lexically_relative(root).string())) continue;
    if (!has_sums(folder) || !has_plan(folder) || verdict_in(folder)) continue;
    rows.push_back(row_without_result(
        root, folder, "its verdict.json is damaged: rvbench check tells what else"));
  }
  return rows;
}

RunRow row_of(const std::filesystem::path& root, const std::filesystem::path& folder,
              const Judgement& judgement) {
  return {.folder = folder.lexically_relative(root).string(),
          .serial = judgement.facts.serial,
          .started_utc = judgement.facts.started_utc,
          .plan = judgement.facts.plan,
          .verdict = to_string(judgement.ending.outcome),
          .error_kind = to_string(judgement.ending.error_kind),
          .reason = judgement.ending.reason,
          .software = judgement.facts.software};
}

}  // namespace rvbench::bench
