#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "hal/types/result.hpp"

namespace rvbench::bench {

/// Somebody's act, for the audit log.
struct AuditEntry {
  std::string user;     ///< "" if nobody was logged in
  std::string address;  ///< where it came from
  std::string action;   ///< "start", "login", "refused start"
  std::string detail;   ///< JSON in text; "" for none
};

/// What a look at an audit log comes to.
struct AuditCheck {
  std::size_t lines = 0;
  std::string last_hash;        ///< of the last sound line before the first broken one
  std::size_t broken_line = 0;  ///< the first, from 1; 0 if none is
  std::string fault = {};       ///< what is wrong with it
  std::string cut_short = {};   ///< what follows the last line's end, as a power failure leaves it
  bool is_last_sound = false;   ///< the last one that there is, whole or cut short
};

/// Who did what, one JSON object a line. Each line carries the hash of the line before and its own:
/// a line that is changed, taken out, put in or moved breaks the chain there. Lines taken from the
/// end do not: results.db has those that were there at the end of a run (results/audit_index.hpp).
///
///     {"time_utc":"20261126T101112Z","user":"anna","address":"127.0.0.1","action":"start",
///      "detail":{...},"previous":"<64 hex digits>","hash":"<64 hex digits>"}
///
/// See bench/hash_chain.hpp. What a power failure left of a last line is taken out of the chain
/// when the log is opened again, and told whole in a line of its own ("cut short"): the act was
/// logged by nobody, and was not done. The first line is "begun", with a word where an earlier log
/// is gone: that of whoever serves the station.
///
/// Threads  any
class AuditLog {
 public:
  /// Makes the file if need be; goes on after its last sound line.
  explicit AuditLog(std::filesystem::path file);
  ~AuditLog();
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;

  /// Whether there was no line when it was opened.
  bool is_new() const { return is_new_; }

  /// On the disk when it returns. What is not logged must not be done: a file that was moved,
  /// deleted or changed by another hand is refused as a full disk is.
  Status add(const AuditEntry& entry);

  /// The newest lines, oldest first, as a JSON array.
  std::string last(std::size_t lines);

 private:
  void mend_end(const AuditCheck& there);
  void note_size();
  Status is_in_place() const;

  std::filesystem::path file_;
  std::mutex mutex_;
  int descriptor_ = -1;
  bool is_new_ = true;
  std::int64_t bytes_ = 0;  // that the file has, if nobody else wrote to it
  std::string previous_;
};

/// nullopt if it cannot be read.
std::optional<AuditCheck> check_audit(const std::filesystem::path& file);

/// Whether the first line of a file is one of an audit log, or was one.
bool is_audit_log(const std::filesystem::path& file);

}  // namespace rvbench::bench
