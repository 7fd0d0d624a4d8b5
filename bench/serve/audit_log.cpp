#include "bench/serve/audit_log.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "bench/hash_chain.hpp"
#include "bench/json_text.hpp"
#include "bench/run_folder.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

std::string line_of_entry(const AuditEntry& entry, const std::string& previous) {
  nlohmann::ordered_json json = hal::json_object({{"time_utc", utc_now()},
                                                  {"user", entry.user},
                                                  {"address", entry.address},
                                                  {"action", entry.action}});
  if (!entry.detail.empty()) {
    json["detail"] = ordered_json_or_discarded(entry.detail);
    if (json["detail"].is_discarded()) json["detail"] = entry.detail;
  }
  return chained_line(std::move(json), previous);
}

IoError failure(const std::filesystem::path& file) {
  return {IoErrc::refused, file.string() + ": " + std::strerror(errno)};
}

}  // namespace

AuditLog::AuditLog(std::filesystem::path file) : file_(std::move(file)), previous_(chain_begin) {
  const auto there = check_audit(file_);
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0640);
  note_size();
  if (!there) return;
  is_new_ = there->lines == 0;
  previous_ = there->last_hash;
  if (!there->cut_short.empty() && descriptor_ >= 0) mend_end(*there);
}

// Where the disk refuses, it stays, and the next line begins below it. A line that lacks only its
// end is a line.
void AuditLog::mend_end(const AuditCheck& there) {
  struct stat now {};
  const std::string& cut_short = there.cut_short;
  const bool is_out =
      !there.is_last_sound && ::fstat(descriptor_, &now) == 0 &&
      ::ftruncate(descriptor_, now.st_size - static_cast<off_t>(cut_short.size())) == 0;
  note_size();
  const nlohmann::json told{{"text", cut_short}};
  if (is_out && add({"", "", "cut short", ascii_json_line(told)})) return;
  if (is_out) (void)::write(descriptor_, cut_short.data(), cut_short.size());
  (void)::write(descriptor_, "\n", 1);
  note_size();
}

void AuditLog::note_size() {
  struct stat now {};
  if (::fstat(descriptor_, &now) == 0) bytes_ = now.st_size;
}

AuditLog::~AuditLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

// A file that was moved or deleted takes whatever is written, and nobody sees it; behind one that
// was cut short lines would follow none.
Status AuditLog::is_in_place() const {
  struct stat open {};
  struct stat named {};
  if (::fstat(descriptor_, &open) != 0) return failure(file_);
  const bool is_this = ::stat(file_.c_str(), &named) == 0 && named.st_dev == open.st_dev &&
                       named.st_ino == open.st_ino;
  if (!is_this) {
    return IoError{IoErrc::refused,
                   file_.string() + " is gone, or another file stands in its place"};
  }
  if (open.st_size == bytes_) return Done{};
  return IoError{IoErrc::refused, file_.string() + " was changed by another hand: serve it anew"};
}

Status AuditLog::add(const AuditEntry& entry) {
  const std::lock_guard lock(mutex_);
  if (const Status there = is_in_place(); !there) return there;
  const std::string line = line_of_entry(entry, previous_) + "\n";
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
  bytes_ = before.st_size + written;
  previous_ = hash_of_line(line.substr(0, line.size() - 1));
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
    auto json = ordered_json_or_discarded(line);
    if (!json.is_discarded()) entries.push_back(std::move(json));
  }
  return json_line(entries);
}

std::optional<AuditCheck> check_audit(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  AuditCheck check{.last_hash = chain_begin};
  for (std::string line; std::getline(in, line);) {
    ++check.lines;
    if (in.eof()) check.cut_short = line;
    const std::string fault = chain_fault(line, check.last_hash);
    check.is_last_sound = fault.empty();
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
