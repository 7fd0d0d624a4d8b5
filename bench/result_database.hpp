#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/judgement.hpp"
#include "hal/types/result.hpp"

struct sqlite3;

namespace rvbench::bench {

/// One judged run.
struct RunRow {
  std::string folder;  ///< below the root: "A17/20261121T114559Z"
  std::string serial;
  std::string started_utc;
  std::string plan;
  std::string verdict;     ///< "PASS", ...; "" if there is none (yet)
  std::string error_kind;  ///< "none", "device_lost", ...
  std::string reason;
  std::string software;

  bool operator==(const RunRow&) const = default;
};

/// The runs below one folder as a table: <root>/results.db, by SQLite in WAL mode, every entry
/// synced to the disk before it counts.
///
/// It is an index, the folders are the truth: a run whose entry failed (the database was locked,
/// the process was killed between verdict and entry) is entered by catch_up() later on.
///
/// Errors   refused: the file is locked for longer than two seconds, is no database, cannot be
///          written; the text says which
/// Threads  one caller at a time; several processes may have it open
class ResultDatabase {
 public:
  static Result<ResultDatabase> open(const std::filesystem::path& root);
  /// Empty until catch_up(), and gone with this object: where results.db cannot be used.
  static Result<ResultDatabase> in_memory(const std::filesystem::path& root);

  /// Enters a run; one that was entered before is replaced.
  Status enter(const RunRow& row);

  /// Enters every run folder with a complete verdict that is missing, and every one that has come
  /// to another verdict since: an ABORTED or ERROR run may be resumed. @return how many
  Result<int> catch_up();

  /// Oldest first. @param serial  empty: of every unit
  Result<std::vector<RunRow>> runs(const std::string& serial = "") const;

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };

  ResultDatabase(std::filesystem::path root, std::unique_ptr<sqlite3, Close> database);
  static Result<ResultDatabase> open_at(const std::filesystem::path& root,
                                        const std::filesystem::path& file);
  Status execute(const char* sql);
  IoError failure(const std::string& what) const;

  std::filesystem::path root_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// The runs below the root that have no result: their verdict is empty. Of what each recorded when
/// it began.
std::vector<RunRow> unfinished_runs(const std::filesystem::path& root);

/// Likewise those that have come to their end, but whose verdict nobody can read any more, nor has
/// it been entered.
std::vector<RunRow> damaged_runs(const std::filesystem::path& root,
                                 const std::vector<RunRow>& entered);

/// The row of a run whose folder lies in `root`.
RunRow row_of(const std::filesystem::path& root, const std::filesystem::path& folder,
              const Judgement& judgement);

}  // namespace rvbench::bench
