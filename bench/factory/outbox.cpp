#include "bench/factory/outbox.hpp"

#include <utility>

#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

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
    "UPDATE results SET state = 'sent', message_id = ?2, payload_sha256 = ?3, sent_utc = ?4 "
    "WHERE result_id = ?1";
constexpr const char* become_acknowledged =
    "UPDATE results SET state = 'acknowledged', payload = '', acknowledged_utc = ?2 "
    "WHERE result_id = (SELECT result_id FROM packets WHERE key = ?1)";
constexpr const char* put_packet =
    "INSERT OR REPLACE INTO packets (key, packet, result_id) VALUES (?1, CAST(?2 AS BLOB), ?3)";
constexpr const char* drop_packet = "DELETE FROM packets WHERE key = ?1";

}  // namespace

Outbox::Outbox(SqliteFile file) : file_(std::move(file)) {}

Result<Outbox> Outbox::open(const std::filesystem::path& root) {
  auto opened = SqliteFile::open(root / outbox_name, root / outbox_name);
  if (!opened) return opened.error();
  Outbox outbox(std::move(opened).value());
  if (const Status made = outbox.file_.execute(schema); !made) return made.error();
  return outbox;
}

Result<bool> Outbox::holds(const std::string& result_id) const {
  return has_any("SELECT 1 FROM results WHERE result_id = ?1", result_id);
}

Result<bool> Outbox::is_acknowledged(const std::string& result_id) const {
  return has_any("SELECT 1 FROM results WHERE result_id = ?1 AND state = 'acknowledged'",
                 result_id);
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
  return texts("SELECT result_id FROM results WHERE state = ?1 ORDER BY place", {state});
}

Result<std::size_t> Outbox::left() const {
  std::size_t count = 0;
  for (const char* state : {"due", "sent"}) {
    const auto ids = ids_of(state);
    if (!ids) return ids.error();
    count += ids.value().size();
  }
  return count;
}

Status Outbox::note_attempt(const std::string& result_id) {
  return execute("UPDATE results SET sends = sends + 1 WHERE result_id = ?1", {result_id});
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

Status Outbox::note_sent_again() {
  return execute("UPDATE results SET sends = sends + 1 WHERE state = 'sent'", {});
}

Status Outbox::put_last(const std::string& result_id) {
  return execute(
      "UPDATE results SET place = (SELECT MAX(place) + 1 FROM results) WHERE result_id = ?1",
      {result_id});
}

Status Outbox::keep_packet(const std::string& key, const std::string& packet) {
  return execute(put_packet, {key, packet, ""});
}

Status Outbox::forget_packet(const std::string& key) { return execute(drop_packet, {key}); }

std::optional<std::string> Outbox::packet(const std::string& key) const {
  const auto found = texts("SELECT packet FROM packets WHERE key = ?1", {key});
  if (!found || found.value().empty()) return std::nullopt;
  return found.value().front();
}

std::vector<std::string> Outbox::packet_keys() const {
  auto found = texts("SELECT key FROM packets ORDER BY key", {});
  return found ? std::move(found).value() : std::vector<std::string>();
}

Result<std::optional<OutboxEntry>> Outbox::entry(const char* sql, const std::string& value) const {
  SqlStatement query(file_, sql);
  query.bind(value);
  if (!query.next()) {
    if (!query.is_done()) return file_.failure("cannot be read");
    return std::optional<OutboxEntry>();
  }
  return std::optional(OutboxEntry{.result_id = query.text(0),
                                   .folder = query.text(1),
                                   .payload = query.text(2),
                                   .state = query.text(3),
                                   .sends = static_cast<int>(query.integer(4)),
                                   .message_id = static_cast<int>(query.integer(5)),
                                   .payload_sha256 = query.text(6)});
}

Status Outbox::execute(const char* sql, const std::vector<std::string>& values) const {
  SqlStatement statement(file_, sql);
  statement.bind_all(values);
  if (!statement.run()) return file_.failure("cannot be written");
  return Done{};
}

Status Outbox::in_one_step(
    const std::vector<std::pair<const char*, std::vector<std::string>>>& work) {
  SqlTransaction transaction(file_);
  if (!transaction.begun()) return transaction.begun();
  for (const auto& [sql, values] : work) {
    if (const Status done = execute(sql, values); !done) return done;
  }
  return transaction.commit();
}

Result<bool> Outbox::has_any(const char* sql, const std::string& value) const {
  const auto found = texts(sql, {value});
  if (!found) return found.error();
  return !found.value().empty();
}

Result<std::vector<std::string>> Outbox::texts(const char* sql,
                                               const std::vector<std::string>& values) const {
  SqlStatement query(file_, sql);
  query.bind_all(values);
  std::vector<std::string> found;
  while (query.next()) found.push_back(query.text(0));
  if (!query.is_done()) return file_.failure("cannot be read");
  return found;
}

}  // namespace rvbench::bench
