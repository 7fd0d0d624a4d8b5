#include "bench/result_database.hpp"

#include <map>
#include <set>
#include <utility>

#include "bench/limits_versions.hpp"
#include "bench/results/audit_index.hpp"
#include "bench/results/entry.hpp"
#include "bench/results/rejudgement.hpp"
#include "bench/results/schema.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

// The columns, in the order of the statement below.
constexpr std::string RunRow::*columns[] = {
    &RunRow::folder,   &RunRow::serial,     &RunRow::started_utc, &RunRow::plan,
    &RunRow::verdict,  &RunRow::error_kind, &RunRow::reason,      &RunRow::software,
    &RunRow::rig_kind, &RunRow::station,    &RunRow::sha256};
constexpr const char* get_runs =
    "SELECT folder, serial, started_utc, plan, verdict, error_kind, reason, software, rig_kind, "
    "station, verdict_sha256, number, is_whole FROM runs WHERE ?1 = '' OR serial = ?1 ORDER BY "
    "started_utc, folder";
constexpr const char* get_later =
    "SELECT runs.folder, file, judged_utc, judgements.software, limits_version, "
    "judgements.verdict, judgements.error_kind, judgements.reason FROM judgements "
    "JOIN runs ON runs.id = judgements.run WHERE file != 'verdict.json' "
    "ORDER BY runs.started_utc, runs.folder, length(file), file";
constexpr const char* get_with_finding =
    "SELECT DISTINCT runs.folder FROM findings JOIN runs ON runs.id = findings.run "
    "WHERE component = ?1 AND standing = 'above_limit'";

struct EnteredRun {
  RunRow row;
  bool is_whole = false;  ///< with all it measured and found
};

Result<std::vector<EnteredRun>> entered_runs(const SqliteFile& file, const std::string& serial) {
  SqlStatement query(file, get_runs);
  query.bind(serial);
  std::vector<EnteredRun> entered;
  while (query.next()) {
    EnteredRun& run = entered.emplace_back();
    int at = 0;
    for (const auto column : columns) run.row.*column = query.text(at++);
    run.row.number = static_cast<int>(query.integer(at++));
    run.is_whole = query.integer(at) != 0;
  }
  if (!query.is_done()) return file.failure("cannot be read");
  return entered;
}

bool may_be_resumed(const RunRow& row) {
  return row.verdict == to_string(Outcome::aborted) || row.verdict == to_string(Outcome::error);
}

}  // namespace

ResultDatabase::ResultDatabase(std::filesystem::path root, SqliteFile file)
    : root_(std::move(root)), file_(std::move(file)) {}

Result<ResultDatabase> ResultDatabase::open(const std::filesystem::path& root) {
  return open_at(root, root / result_database_name);
}

Result<ResultDatabase> ResultDatabase::in_memory(const std::filesystem::path& root) {
  return open_at(root, ":memory:");
}

Result<ResultDatabase> ResultDatabase::open_at(const std::filesystem::path& root,
                                               const std::filesystem::path& file) {
  auto opened = SqliteFile::open(file, root / result_database_name);
  if (!opened) return opened.error();
  ResultDatabase database(root, std::move(opened).value());
  if (const Status made = bring_up_to_date(database.file_); !made) return made.error();
  return database;
}

Status ResultDatabase::enter(const RunRow& row, const Judgement& judgement) {
  SqlTransaction transaction(file_);
  if (!transaction.begun()) return file_.failure("cannot be written");
  if (const Status done = enter_run(file_, row, judgement); !done) return done.error();
  return transaction.commit();
}

Status ResultDatabase::enter(const JudgementRow& row) { return enter_judgement_row(file_, row); }

Result<int> ResultDatabase::catch_up() {
  const auto known = entered_runs(file_, "");
  if (!known) return known.error();
  const auto later = later_judgements();
  if (!later) return later.error();
  std::map<std::string, EnteredRun> entered;
  for (const EnteredRun& run : known.value()) entered.emplace(run.row.folder, run);
  std::map<std::string, std::set<std::string>> files;
  for (const JudgementRow& row : later.value()) files[row.folder].insert(row.file);
  int missing = 0;
  for (const std::filesystem::path& folder : run_folders(root_)) {
    const std::string name = folder.lexically_relative(root_).string();
    const auto old = entered.find(name);
    const bool is_known = old != entered.end();
    const auto done = catch_up_run(folder, is_known ? &old->second.row : nullptr,
                                   is_known && old->second.is_whole);
    if (!done) return done.error();
    const auto more = is_known || done.value() ? catch_up_later(folder, files[name]) : Result(0);
    if (!more) return more.error();
    missing += int{done.value()} + more.value();
  }
  for (const LimitsVersion& limits : limits_versions(root_)) {
    if (limits.file.version.empty()) continue;  // nobody can read it
    const Status done = enter_limits_version(file_, limits);
    if (!done) return done.error();
  }
  const Status recorded = enter_new_records();
  if (!recorded) return recorded.error();
  const Status indexed = enter_audit_lines(file_, audit_log_of(root_));
  if (!indexed) return indexed.error();
  return missing;
}

// Of stations: those whose files have come since.
Status ResultDatabase::enter_new_records() {
  std::set<std::string> known;
  SqlStatement query(file_, "SELECT file FROM calibrations UNION SELECT file FROM self_tests");
  while (query.next()) known.insert(query.text(0));
  if (!query.is_done()) return file_.failure("cannot be read");
  StationRecords records = further_station_records(root_, known);
  std::erase_if(records.self_tests, [](const auto& record) { return !record.has_ended(); });
  if (records.calibrations.empty() && records.self_tests.empty()) return Done{};
  SqlTransaction transaction(file_);
  if (!transaction.begun()) return file_.failure("cannot be written");
  if (const Status done = enter_station_records(file_, records); !done) return done.error();
  return transaction.commit();
}

// @param old  as it was entered before; null if it was not. @return whether it was entered now
Result<bool> ResultDatabase::catch_up_run(const std::filesystem::path& folder, const RunRow* old,
                                          bool is_whole) {
  if (is_whole && !may_be_resumed(*old)) return false;
  if (!has_sums(folder)) return false;  // written last: the verdict is still being written
  if (is_whole && is_as_entered(root_, *old)) return false;
  const auto judgement = judgement_in(folder);
  if (!judgement) return false;
  const RunRow row = row_of(root_, folder, *judgement);
  if (is_whole && row == *old) return false;
  if (const Status done = enter(row, *judgement); !done) return done.error();
  return true;
}

Result<int> ResultDatabase::catch_up_later(const std::filesystem::path& folder,
                                           const std::set<std::string>& known) {
  int missing = 0;
  for (const std::string& name : rejudgement_names(folder)) {
    if (known.contains(name)) continue;
    const auto later = rejudgement_from_json(read_file(folder / name).value_or(""));
    if (!later) continue;
    const Status done = enter(row_of(root_, folder / name, *later));
    if (!done) return done.error();
    ++missing;
  }
  return missing;
}

Result<std::vector<RunRow>> ResultDatabase::runs(const std::string& serial) const {
  const auto entered = entered_runs(file_, serial);
  if (!entered) return entered.error();
  std::vector<RunRow> rows;
  for (const EnteredRun& run : entered.value()) rows.push_back(run.row);
  return rows;
}

Result<std::vector<JudgementRow>> ResultDatabase::later_judgements() const {
  SqlStatement query(file_, get_later);
  std::vector<JudgementRow> rows;
  while (query.next()) {
    rows.push_back({query.text(0), query.text(1), query.text(2), query.text(3), query.text(4),
                    query.text(5), query.text(6), query.text(7)});
  }
  if (!query.is_done()) return file_.failure("cannot be read");
  return rows;
}

Result<std::vector<std::string>> ResultDatabase::activated_limits(const std::string& plan) const {
  SqlStatement query(
      file_, "SELECT version FROM limits_versions WHERE plan = ?1 AND status = 'activated'");
  query.bind(plan);
  std::vector<std::string> versions;
  while (query.next()) versions.push_back(query.text(0));
  if (!query.is_done()) return file_.failure("cannot be read");
  return versions;
}

Result<std::set<std::string>> ResultDatabase::runs_with_finding(
    const std::string& component) const {
  SqlStatement query(file_, get_with_finding);
  query.bind(component);
  std::set<std::string> folders;
  while (query.next()) folders.insert(query.text(0));
  if (!query.is_done()) return file_.failure("cannot be read");
  return folders;
}

Result<std::vector<RunValue>> ResultDatabase::series(const SeriesOf& asked) const {
  return read_series(file_, asked);
}

Result<ResultDatabase> caught_up(Result<ResultDatabase> opened) {
  if (!opened) return opened.error();
  ResultDatabase database = std::move(opened).value();
  if (const auto entered = database.catch_up(); !entered) return entered.error();
  return database;
}

bool is_as_entered(const std::filesystem::path& root, const RunRow& row) {
  return sha256_of_file(root / row.folder / "verdict.json") == row.sha256;
}

RunRow row_of(const std::filesystem::path& root, const std::filesystem::path& folder,
              const Judgement& judgement) {
  const RigOfRun rig = rig_of(folder);
  return {.folder = folder.lexically_relative(root).string(),
          .serial = judgement.facts.serial,
          .started_utc = judgement.facts.started_utc,
          .plan = judgement.facts.plan,
          .verdict = to_string(judgement.ending.outcome),
          .error_kind = to_string(judgement.ending.error_kind),
          .reason = judgement.ending.reason,
          .software = judgement.facts.software,
          .number = read_run_begin(folder).number,
          .rig_kind = rig.kind,
          .station = rig.station,
          .sha256 = sha256_of_file(folder / "verdict.json").value_or("")};
}

JudgementRow row_of(const std::filesystem::path& root, const std::filesystem::path& file,
                    const Rejudgement& rejudgement) {
  const Ending& ending = rejudgement.judgement.ending;
  return {.folder = file.parent_path().lexically_relative(root).string(),
          .file = file.filename().string(),
          .judged_utc = rejudgement.judged_utc,
          .software = rejudgement.judgement.facts.software,
          .limits_version = rejudgement.limits_version,
          .verdict = to_string(ending.outcome),
          .error_kind = to_string(ending.error_kind),
          .reason = ending.reason};
}

}  // namespace rvbench::bench
