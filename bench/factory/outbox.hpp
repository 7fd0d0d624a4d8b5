#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/results/sqlite.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// The outbox, which lies beside the folders of the serials.
inline constexpr const char* outbox_name = "outbox.db";
/// Who holds it sends; the file means nothing else.
inline constexpr const char* outbox_lock_name = "outbox.db.lock";

/// A result on its way to the factory.
struct OutboxEntry {
  std::string result_id;
  std::string folder;               ///< of the run, below the root
  std::string payload;              ///< JSON; "" once it is acknowledged
  std::string state = "due";        ///< then "sent", then "acknowledged"
  int sends = 0;                    ///< how often it may have gone out; above 1: perhaps twice
  int message_id = 0;               ///< of MQTT, when it was sent last
  std::string payload_sha256 = {};  ///< of what was sent last
};

/// What is due to the factory, what was sent and what was acknowledged: <root>/outbox.db, by SQLite
/// in WAL mode, every step synced to the disk before the next is taken.
///
/// It also keeps the packets of MQTT that are under way, each step of theirs in one transaction
/// with that of their result: after a crash both say the same.
///
/// Errors   refused: the file is locked for longer than two seconds, is no database, cannot be
///          written; the text says which
/// Threads  one caller at a time
class Outbox {
 public:
  static Result<Outbox> open(const std::filesystem::path& root);

  Result<bool> holds(const std::string& result_id) const;
  Result<bool> is_acknowledged(const std::string& result_id) const;
  Status enter(const OutboxEntry& due);

  Result<std::optional<OutboxEntry>> next_due() const;  ///< that was entered first
  Result<std::optional<OutboxEntry>> find(const std::string& result_id) const;
  Result<std::vector<std::string>> ids_of(const std::string& state) const;  ///< oldest first

  /// How many are not acknowledged yet.
  Result<std::size_t> left() const;

  /// It may go out from now on: known before anything else is done about it, for a packet may go
  /// out even if it could not be kept.
  Status note_attempt(const std::string& result_id);
  /// Its packet is kept, and goes out.
  Status note_sent(const std::string& result_id, int message_id, const std::string& payload_sha256,
                   const std::string& packet_key, const std::string& packet);
  /// The receiver has the packet: so it has the result.
  Status acknowledge(const std::string& packet_key);
  /// Whatever is under way is given up, and due again.
  Status recall();
  /// What is under way goes out once more, by the broker's memory of it.
  Status note_sent_again();
  /// After all others that are due.
  Status put_last(const std::string& result_id);

  Status keep_packet(const std::string& key, const std::string& packet);
  Status forget_packet(const std::string& key);
  std::optional<std::string> packet(const std::string& key) const;
  std::vector<std::string> packet_keys() const;

 private:
  explicit Outbox(SqliteFile file);

  Status execute(const char* sql, const std::vector<std::string>& values) const;
  Status in_one_step(const std::vector<std::pair<const char*, std::vector<std::string>>>& work);
  /// The first column of each row.
  Result<std::vector<std::string>> texts(const char* sql,
                                         const std::vector<std::string>& values) const;
  Result<bool> has_any(const char* sql, const std::string& value) const;
  Result<std::optional<OutboxEntry>> entry(const char* sql, const std::string& value) const;

  SqliteFile file_;
};

}  // namespace rvbench::bench
