#include "bench/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "bench/sha256.hpp"
#include "bench/verdict_json.hpp"
#include "hal/sync_folder.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_name = 64;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

// Writes and syncs; 0, or errno.
int fill(int fd, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const auto more = write(fd, text.data() + written, text.size() - written);
    if (more < 0 && errno != EINTR) return errno;
    written += static_cast<std::size_t>(std::max<ssize_t>(0, more));
  }
  return fsync(fd) == 0 ? 0 : errno;
}

[[noreturn]] void throw_error(int error, const std::filesystem::path& file) {
  throw std::system_error(error, std::generic_category(), file.string());
}

void sync_folder_of(const std::filesystem::path& file) {
  if (const int error = hal::sync_folder(file); error != 0) throw_error(error, file);
}

// With those above it, each on the disk before the next.
void make_folders(const std::filesystem::path& folder) {
  if (folder.empty() || std::filesystem::exists(folder)) return;
  make_folders(folder.parent_path());
  std::filesystem::create_directory(folder);
  sync_folder_of(folder);
}

}  // namespace

std::string folder_name_of(const std::string& serial) {
  if (serial.empty()) throw std::invalid_argument("folder_name_of: serial is empty");
  std::string name = serial.substr(0, longest_name);
  std::ranges::replace_if(
      name, [](char c) { return !is_plain(c); }, '_');
  if (name.front() == '.' || name.front() == '-') name.front() = '_';
  if (name != serial) name.append("-").append(sha256_of_text(serial), 0, 8);
  return name;
}

std::filesystem::path create_run_folder(const std::filesystem::path& root,
                                        const std::string& serial, const std::string& utc) {
  const std::filesystem::path parent = root / folder_name_of(serial);
  make_folders(parent);
  std::filesystem::path folder = parent / utc;
  for (int copy = 2; !std::filesystem::create_directory(folder); ++copy) {
    folder = parent / fmt::format("{}-{}", utc, copy);
  }
  sync_folder_of(folder);
  return folder;
}

// Sums are written last: a run without them was killed while its results were written.
bool is_finished(const std::filesystem::path& run) {
  if (!has_sums(run)) return false;
  const std::optional<std::string> verdict = read_file(run / "verdict.json");
  if (!verdict) return false;
  const std::optional<Judgement> judgement = judgement_from_json(*verdict);
  return judgement && judgement->ending.outcome != Outcome::aborted &&
         judgement->ending.outcome != Outcome::error;
}

std::optional<std::filesystem::path> newest_unfinished_run(const std::filesystem::path& root,
                                                           const std::string& serial) {
  std::vector<std::filesystem::path> runs;
  std::error_code absent;
  for (const auto& entry :
       std::filesystem::directory_iterator(root / folder_name_of(serial), absent)) {
    if (entry.is_directory() && std::filesystem::exists(entry.path() / "plan.json")) {
      runs.push_back(entry.path());
    }
  }
  if (runs.empty()) return std::nullopt;
  std::ranges::sort(runs);
  if (is_finished(runs.back())) return std::nullopt;
  return runs.back();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}{:02}{:02}T{:02}{:02}{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path draft = file.string() + ".draft";
  const int fd = open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw_error(errno, file);
  int error = fill(fd, text);
  if (close(fd) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(draft.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(draft.c_str());
    throw_error(error, file);
  }
  sync_folder_of(file);
}

std::optional<std::string> read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad() || text.bad()) return std::nullopt;
  return text.str();
}

}  // namespace rvbench::bench
