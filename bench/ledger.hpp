#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/file_lock.hpp"

/// What was kept beside the runs, and in which order: <root>/ledger.jsonl, a chain of lines
/// (bench/hash_chain.hpp).
///
///     {"number":7,"utc":"20261127T080000Z","kind":"limits activated","of":"quick",
///      "file":"limits/2026-11.json","sha256":"...","previous":"...","hash":"..."}
///
/// Which record is the newest is told by its number, as clocks may be set; a file that is missing,
/// that was changed or that nobody kept is told by the hash. It shows what happened by accident, or
/// by a hand that did not think of it; it is no seal against somebody who writes a new ledger.
namespace rvbench::bench {

inline constexpr const char* ledger_name = "ledger.jsonl";
/// The kind of a line that is kept all the same: somebody says that the clock of now is right.
inline constexpr const char* clock_kind = "clock is right";
/// What to say of a file that is not in it.
inline constexpr const char* in_no_line =
    " is in no line of ledger.jsonl, so nobody goes by it: it was put there by hand, or its "
    "keeping was cut short";

/// One line: a file as somebody kept it then.
struct LedgerLine {
  int number = 0;    ///< from 1, without a gap
  std::string utc;   ///< by the clock of then
  std::string kind;  ///< "limits activated", "calibration of accel_1x by K-4711", ...
  std::string of;    ///< what it is for: a station, a plan
  std::string file;  ///< below the root
  std::string sha256;
};

struct Ledger {
  std::vector<LedgerLine> lines;  ///< by number
  std::string fault;  ///< "runs/ledger.jsonl:3: ..." if it cannot be trusted; empty: it can
  bool is_cut_short =
      false;  ///< a line that a power failure left unfinished is no line, nor a fault

  std::string end_hash;  ///< of the last line

  /// The last of that file; null if it was never kept.
  const LedgerLine* last_of(const std::string& file) const;
};

/// The last line of each file, by the file's name. Pointers into that ledger.
std::map<std::string, const LedgerLine*> last_lines(const Ledger& ledger);

/// Without lines where there is none yet, or where it has a fault.
Ledger read_ledger(const std::filesystem::path& root);

/// What is wrong with the clock of now, if the last line is of a time yet to come: nothing is kept
/// then, for whatever counts for a time would count again. Empty: nothing.
std::string clock_fault(const Ledger& ledger, const std::string& now_utc);

/// Why nothing can be kept in a root now: its ledger cannot be trusted, or the clock not. Empty: it
/// can be.
std::string keeping_fault(const std::filesystem::path& root);

/// What is wrong with the file of a line that is the last of it: "runs/limits/a.json is missing",
/// "... was changed since rvbench kept it"; empty: nothing.
std::string fault_of(const std::filesystem::path& root, const LedgerLine& line);

/// All that is wrong with a ledger, with the files it lists, each by its last line, and with what
/// lies in a folder of limits or records and is in no line. Whole run folders may have been moved
/// away; what they came to is in results.db.
std::vector<std::string> ledger_faults(const std::filesystem::path& root);

/// Nothing is kept meanwhile: whoever reads a ledger and then its files finds both alike. In a root
/// without a ledger it holds nothing. Gives up waiting after seconds.
class LedgerReading {
 public:
  explicit LedgerReading(const std::filesystem::path& root);
  ~LedgerReading();
  LedgerReading(const LedgerReading&) = delete;
  LedgerReading& operator=(const LedgerReading&) = delete;

 private:
  int descriptor_ = -1;
};

/// Who may keep files in a root: one at a time, so that what was looked at stays so until it is
/// written.
class LedgerPen {
 public:
  /// Waits while another keeps something; the root is made if need be.
  /// @throws std::system_error  also if another does not let go of it for seconds
  explicit LedgerPen(std::filesystem::path root);

  /// Writes the file, replacing one of that name, and enters it; both are on the disk when this
  /// returns.
  /// @throws std::system_error, also if the ledger cannot be trusted
  void keep(const std::string& kind, const std::string& of, const std::string& file,
            const std::string& text);

  /// Enters a file that is there, on the disk when this returns. @throws as keep()
  void enter(const std::string& kind, const std::string& of, const std::string& file);

 private:
  std::filesystem::path root_;
  FileLock lock_;
};

}  // namespace rvbench::bench
