#include "bench/ledger.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <utility>

#include "bench/on_disk.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::seconds longest_wait{5};  // a file is kept in far less
constexpr std::chrono::milliseconds between_looks{10};

std::string text_of(const LedgerLine& line) {
  const nlohmann::ordered_json json{{"number", line.number}, {"utc", line.utc},
                                    {"kind", line.kind},     {"of", line.of},
                                    {"file", line.file},     {"sha256", line.sha256}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

LedgerLine line_from(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  return {json.at("number").get<int>(),
          json.at("utc"),
          json.at("kind"),
          json.at("of"),
          json.at("file"),
          json.at("sha256")};
}

// The finished lines: what a power failure cut short ends without a line's end.
std::string whole_lines_of(std::string text) {
  text.resize(text.rfind('\n') + 1);
  return text;
}

FileLock lock_of(const std::filesystem::path& root) {
  std::filesystem::create_directories(root);
  const auto end = std::chrono::steady_clock::now() + longest_wait;
  for (;;) {
    auto lock = FileLock::take(root / ledger_name);
    if (lock) return std::move(*lock);
    if (std::chrono::steady_clock::now() > end) throw_error(EWOULDBLOCK, root / ledger_name);
    std::this_thread::sleep_for(between_looks);
  }
}

// After the finished lines, in place of what is left of another.
void append(const std::filesystem::path& file, const std::string& text) {
  const auto whole = static_cast<off_t>(whole_lines_of(read_file(file).value_or("")).size());
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw_error(errno, file);
  int error = errno = 0;
  if (::ftruncate(descriptor, whole) != 0 ||
      ::pwrite(descriptor, text.data(), text.size(), whole) != static_cast<ssize_t>(text.size()) ||
      ::fsync(descriptor) != 0) {
    error = errno != 0 ? errno : ENOSPC;
  }
  ::close(descriptor);
  if (error != 0) throw_error(error, file);
  put_folder_on_disk(file);
}

}  // namespace

const LedgerLine* Ledger::last_of(const std::string& file) const {
  const auto found = std::find_if(lines.rbegin(), lines.rend(),
                                  [&](const LedgerLine& line) { return line.file == file; });
  return found == lines.rend() ? nullptr : &*found;
}

Ledger read_ledger(const std::filesystem::path& root) {
  Ledger ledger;
  const std::filesystem::path file = root / ledger_name;
  const auto text = read_file(file);
  std::error_code unknown;
  if (!text && std::filesystem::exists(std::filesystem::symlink_status(file, unknown))) {
    ledger.fault = file.string() + " cannot be read";
  }
  const std::string whole = whole_lines_of(text.value_or(""));
  for (std::size_t at = 0; at < whole.size();) {
    const std::size_t end = whole.find('\n', at);
    const int number = static_cast<int>(ledger.lines.size()) + 1;
    try {
      ledger.lines.push_back(line_from(whole.substr(at, end - at)));
      if (ledger.lines.back().number == number) {
        at = end + 1;
        continue;
      }
      ledger.lines.pop_back();
      ledger.fault = fmt::format("{}:{}: is not line {}: one was taken out, put in or moved",
                                 file.string(), number, number);
    } catch (const nlohmann::json::exception&) {
      ledger.fault = fmt::format("{}:{}: is no line of a ledger", file.string(), number);
    }
    break;
  }
  return ledger;
}

std::string fault_of(const std::filesystem::path& root, const LedgerLine& line) {
  const std::filesystem::path file = root / line.file;
  const auto hash = sha256_of_file(file);
  if (!hash) return file.string() + " is missing, or cannot be read";
  return *hash == line.sha256 ? "" : file.string() + " was changed since rvbench kept it";
}

std::vector<std::string> ledger_faults(const std::filesystem::path& root) {
  const Ledger ledger = read_ledger(root);
  std::map<std::string, const LedgerLine*> last_by_file;
  for (const LedgerLine& line : ledger.lines) last_by_file[line.file] = &line;
  std::vector<std::string> faults;
  if (!ledger.fault.empty()) faults.push_back(ledger.fault);
  for (const auto& [file, line] : last_by_file) {
    const std::string fault = fault_of(root, *line);
    if (!fault.empty()) faults.push_back(fault);
  }
  return faults;
}

LedgerPen::LedgerPen(std::filesystem::path root) : root_(std::move(root)), lock_(lock_of(root_)) {}

void LedgerPen::keep(const std::string& kind, const std::string& of, const std::string& file,
                     const std::string& text) {
  const Ledger ledger = read_ledger(root_);
  if (!ledger.fault.empty()) {
    throw std::system_error(EUCLEAN, std::generic_category(), ledger.fault);
  }
  const std::filesystem::path path = root_ / file;
  std::filesystem::create_directories(path.parent_path());
  put_folder_on_disk(path.parent_path());
  write_file(path, text);
  const int number = static_cast<int>(ledger.lines.size()) + 1;
  append(root_ / ledger_name, text_of({number, utc_now(), kind, of, file, sha256_of_text(text)}));
}

}  // namespace rvbench::bench
