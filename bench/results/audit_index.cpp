#include "bench/results/audit_index.hpp"

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "bench/hash_chain.hpp"
#include "bench/json_text.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* put_line = "INSERT OR IGNORE INTO audit VALUES (?1, ?2, ?3, ?4, ?5)";
constexpr const char* get_newest = "SELECT hash, line FROM audit ORDER BY rowid DESC LIMIT 1";

// A place in a log: how many lines were read, and the hash of the last.
struct Place {
  std::int64_t line = 0;
  std::string hash = chain_begin;
};

struct AuditLine {
  Place place;
  std::string time_utc, user, action;
};

// The sound lines from there on; check tells of the others.
std::vector<AuditLine> lines_after(std::istream& in, Place place) {
  std::vector<AuditLine> lines;
  for (std::string text; std::getline(in, text);) {
    if (!chain_fault(text, place.hash).empty()) break;
    place = {place.line + 1, hash_of_line(text)};
    const auto json = parse_json(text);
    const auto text_at = [&](const char* key) {
      return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
    };
    lines.push_back({place, text_at("time_utc"), text_at("user"), text_at("action")});
  }
  return lines;
}

// Goes behind the line that was entered last, if the log has it where it was; else nowhere.
Place skip_known(std::istream& in, const SqliteFile& file) {
  SqlStatement newest(file, get_newest);
  if (!newest.next()) return {};
  const Place known{newest.integer(1), newest.text(0)};
  std::string text;
  for (std::int64_t i = 0; i < known.line && std::getline(in, text); ++i) {
  }
  if (in && hash_of_line(text) == known.hash) return known;
  in.clear();
  in.seekg(0);
  return {};
}

}  // namespace

std::filesystem::path station_folder(const std::filesystem::path& runs) {
  return runs / ".station";
}

std::filesystem::path audit_log_of(const std::filesystem::path& runs) {
  return station_folder(runs) / "audit.jsonl";
}

Status enter_audit_lines(SqliteFile& file, const std::filesystem::path& log) {
  std::ifstream in(log);
  if (!in) return Done{};
  const Place known = skip_known(in, file);
  const std::vector<AuditLine> lines = lines_after(in, known);
  if (lines.empty()) return Done{};
  SqlTransaction transaction(file);
  if (!transaction.begun()) return file.failure("cannot be written");
  SqlStatement row(file, put_line);
  for (const AuditLine& line : lines) {
    row.bind(line.place.hash, line.place.line, line.time_utc, line.user, line.action);
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
