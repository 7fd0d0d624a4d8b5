#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "bench/results/sqlite.hpp"
#include "hal/types/result.hpp"

/// The table `audit`: an index of the station's audit log (bench/serve/audit_log.hpp), which does
/// not forget what is taken from that file's end. Errors  refused, as SqliteFile.
namespace rvbench::bench {

/// Where a station keeps its audit log and what tells of its run: below the runs, beside the units.
std::filesystem::path station_folder(const std::filesystem::path& runs);

/// Where the station's log lies.
std::filesystem::path audit_log_of(const std::filesystem::path& runs);

/// Enters the sound lines that are not there yet; nothing where there is no log.
Status enter_audit_lines(SqliteFile& file, const std::filesystem::path& log);

/// Lines that were entered once and are not in the log any more.
struct LostAuditLines {
  std::int64_t count = 0;
  std::string first_utc;  ///< when the first of them was written
};
Result<LostAuditLines> lost_audit_lines(const SqliteFile& file, const std::filesystem::path& log);

}  // namespace rvbench::bench
