#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bench/judgement.hpp"
#include "bench/results/rejudgement.hpp"
#include "bench/results/series.hpp"
#include "bench/results/sqlite.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// One judged run.
struct RunRow {
  std::string folder;  ///< below the root: "A17/20261121T114559Z"
  std::string serial;
  std::string started_utc;
  std::string plan;
  std::string verdict = {};     ///< "PASS", ...; "" if there is none (yet)
  std::string error_kind = {};  ///< "none", "device_lost", ...
  std::string reason = {};
  std::string software = {};
  int number = 0;  ///< among the runs of that serial, in the order they began; 0: not known
  std::string rig_kind = {};  ///< "bench", "sim", "replay"; empty: not known
  std::string station = {};   ///< that its rig names; empty: none
  std::string sha256 = {};    ///< of its verdict.json

  bool operator==(const RunRow&) const = default;
};

/// One judgement of a run: as it was judged then (verdict.json), or later.
struct JudgementRow {
  std::string folder;
  std::string file;  ///< of the run folder
  std::string judged_utc;
  std::string software;
  std::string limits_version;  ///< empty: the limits of the run's own plan
  std::string verdict;
  std::string error_kind;
  std::string reason;

  bool operator==(const JudgementRow&) const = default;
};

/// The runs below one folder with what they measured and found: <root>/results.db, by SQLite in WAL
/// mode, every entry synced to the disk before it counts. results/schema.cpp has the tables.
///
/// It is an index, the folders are the truth: a run whose entry failed (the database was locked,
/// the process was killed between verdict and entry) is entered by catch_up() later on, and so is
/// what an older version of the tables did not hold.
///
/// Errors   as SqliteFile, and refused: the file is of a newer version, which the text names
/// Threads  one caller at a time; several processes may have it open
class ResultDatabase {
 public:
  static Result<ResultDatabase> open(const std::filesystem::path& root);
  /// Empty until catch_up(), and gone with this object: where results.db cannot be used.
  static Result<ResultDatabase> in_memory(const std::filesystem::path& root);

  /// Enters a run with all it measured and found; one that was entered before is replaced.
  Status enter(const RunRow& row, const Judgement& judgement);

  /// Enters a later judgement of a run that has been entered.
  Status enter(const JudgementRow& row);

  /// Enters every run folder with a complete verdict that is missing or not whole, every one that
  /// has come to another verdict since (an ABORTED or ERROR run may be resumed), and later
  /// judgements, versions of limits, records of stations and lines of the audit log. What was told
  /// of a run whose folder is gone stays. @return how many runs and later judgements came
  Result<int> catch_up();

  /// Oldest first. @param serial  empty: of every unit
  Result<std::vector<RunRow>> runs(const std::string& serial = "") const;

  /// Versions of limits of that plan that were activated once.
  Result<std::vector<std::string>> activated_limits(const std::string& plan) const;

  /// All that judged a run after its end, by run and in the order they were made.
  Result<std::vector<JudgementRow>> later_judgements() const;

  /// Folders of the runs that have a finding above its limit on that part.
  Result<std::set<std::string>> runs_with_finding(const std::string& component) const;

  /// The folder of the runs that it tells of.
  const std::filesystem::path& root() const { return root_; }

  /// As read_series().
  Result<std::vector<RunValue>> series(const SeriesOf& asked) const;

 private:
  ResultDatabase(std::filesystem::path root, SqliteFile file);
  static Result<ResultDatabase> open_at(const std::filesystem::path& root,
                                        const std::filesystem::path& file);
  Result<bool> catch_up_run(const std::filesystem::path& folder, const RunRow* old, bool is_whole);
  Status enter_new_records();
  Result<int> catch_up_later(const std::filesystem::path& folder,
                             const std::set<std::string>& known);

  std::filesystem::path root_;
  SqliteFile file_;
};

/// The database once it holds every run there is.
Result<ResultDatabase> caught_up(Result<ResultDatabase> opened);

/// Whether the verdict that was entered is still that of its folder in `root`: what is gone or was
/// changed since vouches for nothing.
bool is_as_entered(const std::filesystem::path& root, const RunRow& row);

/// The row of a run whose folder lies in `root`.
RunRow row_of(const std::filesystem::path& root, const std::filesystem::path& folder,
              const Judgement& judgement);

/// The row of a later judgement, which lies in that file of a run folder in `root`.
JudgementRow row_of(const std::filesystem::path& root, const std::filesystem::path& file,
                    const Rejudgement& rejudgement);

}  // namespace rvbench::bench
