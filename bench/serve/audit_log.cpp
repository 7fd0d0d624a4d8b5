#include "bench/serve/audit_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>

#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

constexpr std::string_view hash_key = ",\"hash\":\"";
constexpr std::size_t hash_digits = 64;
const std::string first_previous(hash_digits, '0');

std::string hash_of_line(const std::string& line) {
  const std::size_t tail = hash_key.size() + hash_digits + 2;  // "}
  if (line.size() < tail || line.compare(line.size() - tail, hash_key.size(), hash_key) != 0 ||
      !line.ends_with("\"}")) {
    return "";
  }
  return line.substr(line.size() - 2 - hash_digits, hash_digits);
}

std::string fault_of(const std::string& line, const std::string& previous) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("previous")) return "is no line of an audit log";
  const std::string hash = hash_of_line(line);
  if (hash.empty()) return "has no hash at its end";
  if (sha256_of_text(line.substr(0, line.size() - hash_key.size() - hash_digits - 2)) != hash) {
    return "was changed: it does not match its hash";
  }
  if (json["previous"] != previous) {
    return "does not follow the line before: one was taken out, put in or moved";
  }
  return "";
}

std::string text_of_entry(const AuditEntry& entry, const std::string& previous) {
  nlohmann::ordered_json json{{"time_utc", utc_now()},
                              {"user", entry.user},
                              {"address", entry.address},
                              {"action", entry.action}};
  if (!entry.detail.empty()) {
    json["detail"] = nlohmann::ordered_json::parse(entry.detail, nullptr, false);
    if (json["detail"].is_discarded()) json["detail"] = entry.detail;
  }
  json["previous"] = previous;
  std::string text = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  text.pop_back();  // its }
  return text;
}

IoError failure(const std::filesystem::path& file) {
  return {IoErrc::refused, file.string() + ": " + std::strerror(errno)};
}

}  // namespace

AuditLog::AuditLog(std::filesystem::path file) : file_(std::move(file)), previous_(first_previous) {
  const auto there = check_audit(file_);
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0640);
  if (!there) return;
  previous_ = there->last_hash;
  if (!there->cut_short.empty() && descriptor_ >= 0) take_out(there->cut_short);
}

// Where the disk refuses, it stays, and the next line begins below it.
void AuditLog::take_out(const std::string& cut_short) {
  struct stat now {};
  const bool is_out =
      ::fstat(descriptor_, &now) == 0 &&
      ::ftruncate(descriptor_, now.st_size - static_cast<off_t>(cut_short.size())) == 0;
  if (!is_out) {
    (void)::write(descriptor_, "\n", 1);
    return;
  }
  const nlohmann::json told{{"text", cut_short}};
  (void)add(
      {"", "", "cut short", told.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)});
}

AuditLog::~AuditLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status AuditLog::add(const AuditEntry& entry) {
  const std::lock_guard lock(mutex_);
  const std::string text = text_of_entry(entry, previous_);
  const std::string hash = sha256_of_text(text);
  const std::string line = fmt::format("{}{}{}\"}}\n", text, hash_key, hash);
  struct stat before {};
  if (::fstat(descriptor_, &before) != 0) return failure(file_);
  errno = 0;
  const ssize_t written = ::write(descriptor_, line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size()) || ::fdatasync(descriptor_) != 0) {
    const Status why = failure(file_);
    // Half a line would spoil the next one; where it stays, the constructor's remedy is left.
    [[maybe_unused]] const int cut = ::ftruncate(descriptor_, before.st_size);
    return why;
  }
  previous_ = hash;
  return Done{};
}

std::string AuditLog::last(std::size_t lines) {
  const std::lock_guard lock(mutex_);
  std::deque<std::string> kept;
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    kept.push_back(std::move(line));
    if (kept.size() > lines) kept.pop_front();
  }
  auto entries = nlohmann::ordered_json::array();
  for (const std::string& line : kept) {
    auto json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (!json.is_discarded()) entries.push_back(std::move(json));
  }
  return entries.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<AuditCheck> check_audit(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  AuditCheck check{.last_hash = first_previous};
  for (std::string line; std::getline(in, line);) {
    ++check.lines;
    if (in.eof()) check.cut_short = line;
    const std::string fault = fault_of(line, check.last_hash);
    if (fault.empty()) {
      check.last_hash = hash_of_line(line);
    } else if (check.broken_line == 0) {
      check.broken_line = check.lines;
      check.fault = in.eof() ? "was cut short, as by a power failure: the station puts that right "
                               "when it is served again"
                             : fault;
    }
  }
  return check;
}

bool is_audit_log(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;  // no pipe is waited for
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) return false;
  return line.find("\"action\"") != std::string::npos &&
         line.find("\"previous\"") != std::string::npos;
}

}  // namespace rvbench::bench
