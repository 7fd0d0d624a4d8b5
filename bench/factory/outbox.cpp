#include "bench/factory/outbox.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <utility>

#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

constexpr int busy_timeout_ms = 2000;

// FULL syncs the log at each commit: a step that was told is on the disk.
constexpr const char* schema = R"sql(
  PRAGMA journal_mode = WAL;
  PRAGMA synchronous = FULL;
  CREATE TABLE IF NOT EXISTS results (
    place INTEGER PRIMARY KEY AUTOINCREMENT, result_id TEXT NOT NULL UNIQUE, folder TEXT NOT NULL,
    payload TEXT NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('due', 'sent', 'acknowledged')),
    sends INTEGER NOT NULL, message_id INTEGER NOT NULL, payload_sha256 TEXT NOT NULL,
    entered_utc TEXT NOT NULL, sent_utc TEXT NOT NULL, acknowledged_utc TEXT NOT NULL);
  CREATE INDEX IF NOT EXISTS results_of_state ON results (state, place);
  CREATE TABLE IF NOT EXISTS packets (
    key TEXT PRIMARY KEY, packet BLOB NOT NULL, result_id TEXT NOT NULL);
)sql";

constexpr const char* enter_due =
    "INSERT INTO results (result_id, folder, payload, state, sends, message_id, payload_sha256, "
    "entered_utc, sent_utc, acknowledged_utc) VALUES (?1, ?2, ?3, 'due', 0, 0, '', ?4, '', '')";
constexpr const char* columns_of_first_due =
    "SELECT result_id, folder, payload, state, sends, message_id, payload_sha256 FROM results "
    "WHERE state = ?1 ORDER BY place LIMIT 1";
constexpr const char* columns_of_id =
    "SELECT result_id, folder, payload, state, sends, message_id, payload_sha256 FROM results "
    "WHERE result_id = ?1";
constexpr const char* become_sent =
    "UPDATE results SET state = 'sent', sends = sends + 1, message_id = ?2, payload_sha256 = ?3, "
    "sent_utc = ?4 WHERE result_id = ?1";
constexpr const char* become_acknowledged =
    "UPDATE results SET state = 'acknowledged', payload = '', acknowledged_utc = ?2 "
    "WHERE result_id = (SELECT result_id FROM packets WHERE key = ?1)";
constexpr const char* put_packet =
    "INSERT OR REPLACE INTO packets (key, packet, result_id) VALUES (?1, CAST(?2 AS BLOB), ?3)";
constexpr const char* drop_packet = "DELETE FROM packets WHERE key = ?1";

struct Finalize {
  void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

Statement prepare(sqlite3* database, const char* sql, const std::vector<std::string>& values) {
  sqlite3_stmt* made = nullptr;
  sqlite3_prepare_v2(database, sql, -1, &made, nullptr);
  Statement statement(made);
  int at = 0;
  for (const std::string& value : values) {
    sqlite3_bind_text(made, ++at, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
  }
  return statement;
}

// Also of a blob, whatever bytes it holds.
std::string bytes_of(const Statement& statement, int column) {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement.get(), column));
  const int count = sqlite3_column_bytes(statement.get(), column);
  return bytes == nullptr ? "" : std::string(bytes, static_cast<std::size_t>(count));
}

}  // namespace

void Outbox::Close::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }

Outbox::Outbox(std::filesystem::path file, std::unique_ptr<sqlite3, Close> database)
    : file_(std::move(file)), database_(std::move(database)) {}

Result<Outbox> Outbox::open(const std::filesystem::path& root) {
  const std::filesystem::path file = root / outbox_name;
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  Outbox outbox(file, std::unique_ptr<sqlite3, Close>(opened));
  if (code != SQLITE_OK) return outbox.failure("cannot be opened");
  sqlite3_busy_timeout(opened, busy_timeout_ms);
  if (sqlite3_exec(opened, schema, nullptr, nullptr, nullptr) != SQLITE_OK) {
    return outbox.failure("cannot be used");
  }
  return outbox;
}

Result<bool> Outbox::holds(const std::string& result_id) const {
  const auto found = rows("SELECT 1 FROM results WHERE result_id = ?1", {result_id});
  if (!found) return found.error();
  return !found.value().empty();
}

Result<bool> Outbox::is_acknowledged(const std::string& result_id) const {
  const auto found =
      rows("SELECT 1 FROM results WHERE result_id = ?1 AND state = 'acknowledged'", {result_id});
  if (!found) return found.error();
  return !found.value().empty();
}

Status Outbox::enter(const OutboxEntry& due) {
  return execute(enter_due, {due.result_id, due.folder, due.payload, utc_now()});
}

Result<std::optional<OutboxEntry>> Outbox::next_due() const {
  return entry(columns_of_first_due, "due");
}

Result<std::optional<OutboxEntry>> Outbox::find(const std::string& result_id) const {
  return entry(columns_of_id, result_id);
}

Result<std::vector<std::string>> Outbox::ids_of(const std::string& state) const {
  const auto found = rows("SELECT result_id FROM results WHERE state = ?1 ORDER BY place", {state});
  if (!found) return found.error();
  std::vector<std::string> ids;
  for (const auto& row : found.value()) ids.push_back(row.front());
  return ids;
}

Status Outbox::note_sent(const std::string& result_id, int message_id,
                         const std::string& payload_sha256, const std::string& packet_key,
                         const std::string& packet) {
  return in_one_step(
      {{become_sent, {result_id, std::to_string(message_id), payload_sha256, utc_now()}},
       {put_packet, {packet_key, packet, result_id}}});
}

Status Outbox::acknowledge(const std::string& packet_key) {
  return in_one_step({{become_acknowledged, {packet_key, utc_now()}}, {drop_packet, {packet_key}}});
}

Status Outbox::recall() {
  return in_one_step(
      {{"DELETE FROM packets", {}}, {"UPDATE results SET state = 'due' WHERE state = 'sent'", {}}});
}

Status Outbox::keep_packet(const std::string& key, const std::string& packet) {
  return execute(put_packet, {key, packet, ""});
}

Status Outbox::forget_packet(const std::string& key) { return execute(drop_packet, {key}); }

std::optional<std::string> Outbox::packet(const std::string& key) const {
  const auto found = rows("SELECT packet FROM packets WHERE key = ?1", {key});
  if (!found || found.value().empty()) return std::nullopt;
  return found.value().front().front();
}

std::vector<std::string> Outbox::packet_keys() const {
  std::vector<std::string> keys;
  const auto found = rows("SELECT key FROM packets ORDER BY key", {});
  if (!found) return keys;
  for (const auto& row : found.value()) keys.push_back(row.front());
  return keys;
}

Result<std::optional<OutboxEntry>> Outbox::entry(const char* sql, const std::string& value) const {
  const auto found = rows(sql, {value});
  if (!found) return found.error();
  if (found.value().empty()) return std::optional<OutboxEntry>();
  const auto& row = found.value().front();
  return std::optional(OutboxEntry{.result_id = row[0],
                                   .folder = row[1],
                                   .payload = row[2],
                                   .state = row[3],
                                   .sends = std::stoi(row[4]),
                                   .message_id = std::stoi(row[5]),
                                   .payload_sha256 = row[6]});
}

Status Outbox::execute(const char* sql, const std::vector<std::string>& values) const {
  const Statement statement = prepare(database_.get(), sql, values);
  if (sqlite3_step(statement.get()) != SQLITE_DONE) return failure("cannot be written");
  return Done{};
}

Status Outbox::in_one_step(
    const std::vector<std::pair<const char*, std::vector<std::string>>>& work) {
  if (const Status begun = execute("BEGIN IMMEDIATE", {}); !begun) return begun;
  for (const auto& [sql, values] : work) {
    if (const Status done = execute(sql, values); !done) {
      (void)execute("ROLLBACK", {});
      return done;
    }
  }
  const Status kept = execute("COMMIT", {});
  if (!kept) (void)execute("ROLLBACK", {});
  return kept;
}

Result<std::vector<std::vector<std::string>>> Outbox::rows(
    const char* sql, const std::vector<std::string>& values) const {
  const Statement statement = prepare(database_.get(), sql, values);
  std::vector<std::vector<std::string>> found;
  int code = SQLITE_ERROR;
  while (statement && (code = sqlite3_step(statement.get())) == SQLITE_ROW) {
    auto& row = found.emplace_back();
    for (int column = 0; column < sqlite3_column_count(statement.get()); ++column) {
      row.push_back(bytes_of(statement, column));
    }
  }
  if (code != SQLITE_DONE) return failure("cannot be read");
  return found;
}

IoError Outbox::failure(const std::string& what) const {
  return {IoErrc::refused,
          fmt::format("{} {}: {}", file_.string(), what, sqlite3_errmsg(database_.get()))};
}

}  // namespace rvbench::bench
