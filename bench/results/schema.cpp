#include "bench/results/schema.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

namespace rvbench::bench {
namespace {

// Without WAL a reader would lock a writer out; FULL syncs the log at each commit.
constexpr const char* mode = "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;";

// 1: the runs alone. Such files say 0, as an empty one does.
constexpr const char* runs_alone = R"sql(
  CREATE TABLE IF NOT EXISTS runs (
    folder TEXT PRIMARY KEY, serial TEXT NOT NULL, started_utc TEXT NOT NULL, plan TEXT NOT NULL,
    verdict TEXT NOT NULL, error_kind TEXT NOT NULL, reason TEXT NOT NULL, software TEXT NOT NULL);
  CREATE INDEX IF NOT EXISTS runs_of_serial ON runs (serial, started_utc);
)sql";

// 2: what each run measured and found, every judgement of it, and the versions of the limits.
// Runs that were entered before are not whole: their folders tell the rest. A quantity has a number
// of its own, for there are thousands of values a run.
constexpr const char* what_was_measured = R"sql(
  ALTER TABLE runs RENAME TO runs_alone;
  DROP INDEX IF EXISTS runs_of_serial;
  CREATE TABLE units (serial TEXT PRIMARY KEY, machine TEXT NOT NULL);
  CREATE TABLE runs (
    id INTEGER PRIMARY KEY, folder TEXT NOT NULL UNIQUE, serial TEXT NOT NULL,
    started_utc TEXT NOT NULL, plan TEXT NOT NULL, verdict TEXT NOT NULL,
    error_kind TEXT NOT NULL, reason TEXT NOT NULL, software TEXT NOT NULL,
    is_whole INTEGER NOT NULL);
  CREATE INDEX runs_of_serial ON runs (serial, started_utc);
  CREATE TABLE points (
    run INTEGER NOT NULL REFERENCES runs (id), point INTEGER NOT NULL, status TEXT NOT NULL,
    speed_rpm REAL, load_pct REAL, repeat INTEGER NOT NULL, torque_Nm REAL,
    PRIMARY KEY (run, point)) WITHOUT ROWID;
  CREATE TABLE quantities (
    id INTEGER PRIMARY KEY, measure TEXT NOT NULL, of_what TEXT NOT NULL, unit TEXT NOT NULL,
    UNIQUE (measure, of_what, unit));
  CREATE TABLE indicators (
    quantity INTEGER NOT NULL REFERENCES quantities (id), run INTEGER NOT NULL,
    point INTEGER NOT NULL, channel TEXT NOT NULL, value REAL NOT NULL,
    PRIMARY KEY (quantity, run, point, channel)) WITHOUT ROWID;
  CREATE TABLE findings (
    run INTEGER NOT NULL REFERENCES runs (id), rank INTEGER NOT NULL, standing TEXT NOT NULL,
    component TEXT NOT NULL, mechanism TEXT NOT NULL, table4_item TEXT NOT NULL,
    shaft_order REAL, depth REAL, depth_low REAL, depth_high REAL, depth_limit REAL, p_value REAL,
    confidence REAL, PRIMARY KEY (run, rank)) WITHOUT ROWID;
  CREATE INDEX findings_of_component ON findings (component, standing);
  CREATE TABLE judgements (
    run INTEGER NOT NULL REFERENCES runs (id), file TEXT NOT NULL, judged_utc TEXT NOT NULL,
    software TEXT NOT NULL, limits_version TEXT NOT NULL, verdict TEXT NOT NULL,
    error_kind TEXT NOT NULL, reason TEXT NOT NULL, PRIMARY KEY (run, file)) WITHOUT ROWID;
  CREATE TABLE limits_versions (
    version TEXT PRIMARY KEY, plan TEXT NOT NULL, status TEXT NOT NULL,
    approved_by TEXT NOT NULL, approved_utc TEXT NOT NULL, activated_by TEXT NOT NULL,
    activated_utc TEXT NOT NULL);
  INSERT INTO runs (folder, serial, started_utc, plan, verdict, error_kind, reason, software,
                    is_whole)
    SELECT folder, serial, started_utc, plan, verdict, error_kind, reason, software, 0
    FROM runs_alone;
  INSERT INTO units SELECT DISTINCT serial, '' FROM runs;
  DROP TABLE runs_alone;
)sql";

// 3: what stations have shown: an index of the folder of qualification, whose files tell all.
constexpr const char* what_stations_showed = R"sql(
  CREATE TABLE calibrations (
    file TEXT PRIMARY KEY, station TEXT NOT NULL, channel TEXT NOT NULL, sensitivity REAL,
    certificate TEXT NOT NULL, entered_by TEXT NOT NULL, calibrated_utc TEXT NOT NULL,
    valid_until_utc TEXT NOT NULL, entered_utc TEXT NOT NULL, software TEXT NOT NULL);
  CREATE TABLE self_tests (
    file TEXT PRIMARY KEY, station TEXT NOT NULL, tested_utc TEXT NOT NULL, software TEXT NOT NULL,
    passed INTEGER NOT NULL, reason TEXT NOT NULL);
  CREATE TABLE self_test_readings (
    file TEXT NOT NULL REFERENCES self_tests (file), step TEXT NOT NULL, of_what TEXT NOT NULL,
    value REAL, bound REAL, unit TEXT NOT NULL, word TEXT NOT NULL,
    PRIMARY KEY (file, step, of_what)) WITHOUT ROWID;
)sql";

// 4: the greatest and the least of each quantity in each channel of a run: history and trend ask
// for the worst of all points, of which a plan has 63. Bare columns beside MAX() or MIN() are of
// the row of the extreme: SQLite, "Bare columns in an aggregate query".
constexpr const char* extremes_of_runs = R"sql(
  CREATE TABLE extremes (
    quantity INTEGER NOT NULL REFERENCES quantities (id), run INTEGER NOT NULL,
    channel TEXT NOT NULL, greatest REAL NOT NULL, greatest_point INTEGER NOT NULL,
    least REAL NOT NULL, least_point INTEGER NOT NULL,
    PRIMARY KEY (quantity, run, channel)) WITHOUT ROWID;
  INSERT INTO extremes
    SELECT quantity, run, channel, most.value, most.point, fewest.value, fewest.point
    FROM (SELECT quantity, run, channel, MAX(value) AS value, point FROM indicators
          GROUP BY quantity, run, channel) AS most
    JOIN (SELECT quantity, run, channel, MIN(value) AS value, point FROM indicators
          GROUP BY quantity, run, channel) AS fewest
    USING (quantity, run, channel);
)sql";

// 5: where each run was made, which of its serial it was, and the verdict that was entered, by its
// hash. All of it is in the folders.
constexpr const char* where_runs_were_made = R"sql(
  ALTER TABLE runs ADD COLUMN number INTEGER NOT NULL DEFAULT 0;
  ALTER TABLE runs ADD COLUMN rig_kind TEXT NOT NULL DEFAULT '';
  ALTER TABLE runs ADD COLUMN station TEXT NOT NULL DEFAULT '';
  ALTER TABLE runs ADD COLUMN verdict_sha256 TEXT NOT NULL DEFAULT '';
  UPDATE runs SET is_whole = 0;
)sql";

// 6: who did what: an index of the station's audit log. Addresses and details stay in the log,
// which not everybody may read.
constexpr const char* who_did_what = R"sql(
  CREATE TABLE audit (
    hash TEXT NOT NULL UNIQUE, line INTEGER NOT NULL, time_utc TEXT NOT NULL, user TEXT NOT NULL,
    action TEXT NOT NULL);
)sql";

constexpr std::array table_steps = {runs_alone,       what_was_measured,    what_stations_showed,
                                    extremes_of_runs, where_runs_were_made, who_did_what};

Result<int> version_of(const SqliteFile& file) {
  SqlStatement asked(file, "PRAGMA user_version");
  if (!asked.next()) return file.failure("cannot be used");
  return static_cast<int>(asked.integer(0));
}

}  // namespace

const int schema_version = static_cast<int>(table_steps.size());

Status bring_up_to_date(SqliteFile& file) {
  const Result<int> seen = version_of(file);
  if (!seen) return seen.error();
  if (seen.value() > schema_version) {
    return IoError{IoErrc::refused,
                   fmt::format("{} is of version {}, and this rvbench knows {}: use the rvbench "
                               "that made it, or a newer one",
                               file.name(), seen.value(), schema_version)};
  }
  if (const Status set = file.execute(mode); !set) return set.error();
  if (seen.value() == schema_version) return Done{};
  SqlTransaction transaction(file);
  if (!transaction.begun()) return transaction.begun().error();
  const Result<int> now = version_of(file);  // another process may have been at it
  if (!now) return now.error();
  for (int step = now.value(); step < schema_version; ++step) {
    if (const Status done = file.execute(table_steps[std::size_t(step)]); !done)
      return done.error();
  }
  const std::string set = fmt::format("PRAGMA user_version = {}", schema_version);
  if (const Status done = file.execute(set.c_str()); !done) return done.error();
  return transaction.commit();
}

}  // namespace rvbench::bench
