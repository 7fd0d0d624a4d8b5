#include "bench/results/audit_index.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "bench/hash_chain.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* put_line = "INSERT OR IGNORE INTO audit VALUES (?1, ?2, ?3, ?4, ?5, ?6)";

struct AuditLine {
  std::string hash, time_utc, user, address, action, detail;
};

// Without what is no line of a log.
std::vector<AuditLine> lines_after(std::istream& in, std::string previous) {
  std::vector<AuditLine> lines;
  for (std::string text; std::getline(in, text);) {
    if (!chain_fault(text, previous).empty()) break;  // check tells
    previous = hash_of_line(text);
    const auto json = nlohmann::ordered_json::parse(text);
    const auto text_at = [&](const char* key) {
      return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
    };
    lines.push_back({previous, text_at("time_utc"), text_at("user"), text_at("address"),
                     text_at("action"), json.contains("detail") ? json["detail"].dump() : ""});
  }
  return lines;
}

// The newest line that is known, if the log has it where it was: the others need not be read again.
std::string skip_known(std::istream& in, const SqliteFile& file) {
  SqlStatement newest(file,
                      "SELECT count(*), (SELECT hash FROM audit ORDER BY rowid DESC LIMIT 1) "
                      "FROM audit");
  if (!newest.next()) return chain_begin;
  const std::string hash = newest.text(1);
  std::string text;
  for (std::int64_t i = newest.integer(0); i > 0; --i) std::getline(in, text);
  if (in && !hash.empty() && hash_of_line(text) == hash) return hash;
  in.clear();
  in.seekg(0);
  return chain_begin;
}

}  // namespace

std::filesystem::path audit_log_of(const std::filesystem::path& runs) {
  return runs / ".station" / "audit.jsonl";
}

Status enter_audit_lines(SqliteFile& file, const std::filesystem::path& log) {
  std::ifstream in(log);
  if (!in) return Done{};
  const std::string previous = skip_known(in, file);
  const std::vector<AuditLine> lines = lines_after(in, previous);
  if (lines.empty()) return Done{};
  SqlTransaction transaction(file);
  if (!transaction.begun()) return file.failure("cannot be written");
  SqlStatement row(file, put_line);
  for (const AuditLine& line : lines) {
    row.bind(line.hash, line.time_utc, line.user, line.address, line.action, line.detail);
    if (!row.run()) return file.failure("cannot be written");
  }
  return transaction.commit();
}

Result<LostAuditLines> lost_audit_lines(const SqliteFile& file, const std::filesystem::path& log) {
  std::set<std::string> there;
  std::ifstream in(log);
  for (std::string text; std::getline(in, text);) there.insert(hash_of_line(text));
  LostAuditLines lost;
  SqlStatement known(file, "SELECT hash, time_utc FROM audit ORDER BY rowid");
  while (known.next()) {
    if (there.contains(known.text(0))) continue;
    if (lost.count++ == 0) lost.first_utc = known.text(1);
  }
  if (!known.is_done()) return file.failure("cannot be read");
  return lost;
}

}  // namespace rvbench::bench
