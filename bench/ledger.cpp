#include "bench/ledger.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "bench/hash_chain.hpp"
#include "bench/json_text.hpp"
#include "bench/limits_versions.hpp"
#include "bench/on_disk.hpp"
#include "bench/qualification/ages.hpp"
#include "bench/qualification/station_records.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::seconds longest_wait{5};  // a file is kept in far less
constexpr std::chrono::milliseconds between_looks{10};

std::string text_of(const LedgerLine& line, const std::string& previous) {
  return chained_line({{"number", line.number},
                       {"utc", line.utc},
                       {"kind", line.kind},
                       {"of", line.of},
                       {"file", line.file},
                       {"sha256", line.sha256}},
                      previous) +
         "\n";
}

LedgerLine line_from(const std::string& text) {
  const auto json = parse_json(text);
  return {json.at("number").get<int>(),
          json.at("utc"),
          json.at("kind"),
          json.at("of"),
          json.at("file"),
          json.at("sha256")};
}

// The finished lines, and how many bytes they take. A last one that lacks only its end is one.
struct WholeLines {
  std::vector<std::string> lines;
  std::size_t bytes = 0;
};

WholeLines whole_lines_of(const std::string& text) {
  WholeLines whole;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    if (end == text.size() && hash_of_line(line).empty()) break;
    whole.lines.push_back(std::move(line));
    at = end + 1;
    whole.bytes = std::min(at, text.size());
  }
  return whole;
}

// Whether it was taken before a file could have been kept several times over.
template <typename Take>
bool is_taken_in_time(Take take) {
  const auto end = std::chrono::steady_clock::now() + longest_wait;
  while (!take()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(between_looks);
  }
  return true;
}

FileLock lock_of(const std::filesystem::path& root) {
  std::filesystem::create_directories(root);
  const std::filesystem::path file = root / ledger_name;
  std::optional<FileLock> lock;
  const auto take = [&] { return (lock = FileLock::take(file)).has_value(); };
  if (!is_taken_in_time(take)) {
    throw std::system_error(
        EWOULDBLOCK, std::generic_category(),
        file.string() + " is held by another rvbench: wait for its end, or stop it");
  }
  return std::move(*lock);
}

// After the finished lines, in place of what is left of another.
void append(const std::filesystem::path& file, std::string text) {
  const std::string there = read_file(file).value_or("");
  const std::size_t whole = whole_lines_of(there).bytes;
  if (whole > 0 && there[whole - 1] != '\n') text.insert(0, "\n");
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw_error(errno, file);
  int error = errno = 0;
  if (::ftruncate(descriptor, static_cast<off_t>(whole)) != 0 ||
      ::pwrite(descriptor, text.data(), text.size(), static_cast<off_t>(whole)) !=
          static_cast<ssize_t>(text.size()) ||
      ::fsync(descriptor) != 0) {
    error = errno != 0 ? errno : ENOSPC;
  }
  ::close(descriptor);
  if (error != 0) throw_error(error, file);
  put_folder_on_disk(file);
}

// Whatever the clock says, somebody may say that it is right.
std::string keeping_fault_of(const Ledger& ledger, const std::filesystem::path& root,
                             const std::string& kind) {
  if (!ledger.fault.empty() || kind == clock_kind) return ledger.fault;
  const std::string fault = clock_fault(ledger, utc_now());
  return fault.empty() ? "" : root.string() + "/" + fault;
}

// A ledger that a line of that kind can be added to. @throws std::system_error
Ledger open_ledger(const std::filesystem::path& root, const std::string& kind) {
  Ledger ledger = read_ledger(root);
  const std::string fault = keeping_fault_of(ledger, root, kind);
  if (!fault.empty()) throw std::system_error(EPERM, std::generic_category(), fault);
  return ledger;
}

// With the number and the time of now. @throws std::system_error
void add_line(const std::filesystem::path& root, const Ledger& ledger, LedgerLine line) {
  line.number = static_cast<int>(ledger.lines.size()) + 1;
  line.utc = utc_now();
  append(root / ledger_name, text_of(line, ledger.end_hash));
}

}  // namespace

const LedgerLine* Ledger::last_of(const std::string& file) const {
  const auto found = std::find_if(lines.rbegin(), lines.rend(),
                                  [&](const LedgerLine& line) { return line.file == file; });
  return found == lines.rend() ? nullptr : &*found;
}

std::map<std::string, const LedgerLine*> last_lines(const Ledger& ledger) {
  std::map<std::string, const LedgerLine*> last_by_file;
  for (const LedgerLine& line : ledger.lines) last_by_file[line.file] = &line;
  return last_by_file;
}

Ledger read_ledger(const std::filesystem::path& root) {
  Ledger ledger;
  ledger.end_hash = chain_begin;
  const std::filesystem::path file = root / ledger_name;
  const auto text = read_file(file);
  std::error_code unknown;
  if (!text && std::filesystem::exists(std::filesystem::symlink_status(file, unknown))) {
    ledger.fault = file.string() + " cannot be read";
  }
  const WholeLines whole = whole_lines_of(text.value_or(""));
  ledger.is_cut_short = whole.bytes < text.value_or("").size();
  for (const std::string& line : whole.lines) {
    std::string fault = chain_fault(line, ledger.end_hash);
    try {
      if (fault.empty()) ledger.lines.push_back(line_from(line));
    } catch (const nlohmann::json::exception&) {
      fault = "is no line of a ledger";
    }
    if (!fault.empty()) {
      ledger.fault = fmt::format("{}:{}: {}", file.string(), ledger.lines.size() + 1, fault);
      ledger.lines.clear();  // what stood before it may not be all
      break;
    }
    ledger.end_hash = hash_of_line(line);
  }
  return ledger;
}

std::string clock_fault(const Ledger& ledger, const std::string& now_utc) {
  if (ledger.lines.empty() || !is_ahead(ledger.lines.back().utc, now_utc)) return "";
  return fmt::format(
      "{}: its last line is of {}, which is yet to come by this computer's clock ({}): put the "
      "clock right, or say that it is right: rvbench qualify clock",
      ledger_name, readable_utc(ledger.lines.back().utc), readable_utc(now_utc));
}

std::string keeping_fault(const std::filesystem::path& root) {
  return keeping_fault_of(read_ledger(root), root, "");
}

std::string fault_of(const std::filesystem::path& root, const LedgerLine& line) {
  const std::filesystem::path file = root / line.file;
  const auto hash = sha256_of_file(file);
  if (!hash) return file.string() + " is missing, or cannot be read";
  return *hash == line.sha256
             ? ""
             : file.string() + " was changed since rvbench kept it, or its keeping was cut short";
}

std::vector<std::string> ledger_faults(const std::filesystem::path& root) {
  const LedgerReading reading(root);
  const Ledger ledger = read_ledger(root);
  if (!ledger.fault.empty()) return {ledger.fault};
  const auto last_by_file = last_lines(ledger);
  std::vector<std::string> faults;
  std::set<std::filesystem::path> folders{limits_folder_name, qualification_folder_name};
  for (const auto& [file, line] : last_by_file) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    const bool is_of_run = folder.has_parent_path();
    std::error_code unknown;
    if (is_of_run && !std::filesystem::exists(root / folder, unknown)) continue;  // moved away
    const std::string fault = fault_of(root, *line);
    if (!fault.empty()) faults.push_back(fault);
    if (!is_of_run) folders.insert(folder);
  }
  for (const std::filesystem::path& folder : folders) {
    for (const std::filesystem::path& file : json_files_in(root / folder)) {
      if (last_by_file.contains((folder / file.filename()).string())) continue;
      faults.push_back(file.string() + in_no_line);
    }
  }
  return faults;
}

LedgerReading::LedgerReading(const std::filesystem::path& root)
    : descriptor_(::open((root / ledger_name).c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  const auto take = [&] { return descriptor_ < 0 || ::flock(descriptor_, LOCK_SH | LOCK_NB) == 0; };
  (void)is_taken_in_time(take);
}

LedgerReading::~LedgerReading() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

LedgerPen::LedgerPen(std::filesystem::path root) : root_(std::move(root)), lock_(lock_of(root_)) {}

void LedgerPen::keep(const std::string& kind, const std::string& of, const std::string& file,
                     const std::string& text) {
  const Ledger ledger = open_ledger(root_, kind);
  const std::filesystem::path path = root_ / file;
  std::filesystem::create_directories(path.parent_path());
  put_folder_on_disk(path.parent_path());
  write_file(path, text);
  add_line(root_, ledger, {0, "", kind, of, file, sha256_of_text(text)});
}

void LedgerPen::enter(const std::string& kind, const std::string& of, const std::string& file) {
  const Ledger ledger = open_ledger(root_, kind);
  const auto hash = sha256_of_file(root_ / file);
  if (!hash) throw_error(errno != 0 ? errno : EIO, root_ / file);
  add_line(root_, ledger, {0, "", kind, of, file, *hash});
}

}  // namespace rvbench::bench
