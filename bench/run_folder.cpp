#include "bench/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <vector>

#include "bench/factory/outbox.hpp"
#include "bench/json_text.hpp"
#include "bench/judgement.hpp"
#include "bench/ledger.hpp"
#include "bench/limits_versions.hpp"
#include "bench/on_disk.hpp"
#include "bench/qualification/station_records.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_name = 64;
constexpr std::uint64_t most_runs = 1'000'000'000;

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

// Discarded if it is none.
nlohmann::json json_in(const std::filesystem::path& file) {
  return json_or_discarded(read_file(file).value_or(""));
}

std::string text_in(const nlohmann::json& json, const char* key) {
  const bool is_there = json.is_object() && json.contains(key) && json[key].is_string();
  return is_there ? json[key].get<std::string>() : "";
}

nlohmann::json object_in(const nlohmann::json& json, const char* key) {
  return json.is_object() ? json.value(key, nlohmann::json()) : nlohmann::json();
}

// With those above it, each on the disk before the next.
void make_folders(const std::filesystem::path& folder) {
  if (folder.empty() || std::filesystem::exists(folder)) return;
  make_folders(folder.parent_path());
  std::filesystem::create_directory(folder);
  put_folder_on_disk(folder);
}

// Runs of one serial in the order in which they began. Without numbers it is that of their names:
// "20260102T030405Z", "20260102T030405Z-2", ..., "20260102T030405Z-10".
std::tuple<int, std::string, std::size_t, std::string> order_of(const std::filesystem::path& run) {
  const std::string name = run.filename().string();
  const std::string second = name.substr(0, name.find('-'));
  return {read_run_begin(run).number, second, name.size(), name};
}

}  // namespace

std::vector<std::filesystem::path> folders_in(const std::filesystem::path& parent) {
  std::vector<std::filesystem::path> folders;
  std::error_code error;
  using Entries = std::filesystem::directory_iterator;
  for (Entries entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    if (entry->is_directory(unknown)) folders.push_back(entry->path());
  }
  return folders;
}

std::vector<std::filesystem::path> json_files_in(const std::filesystem::path& parent) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  using Entries = std::filesystem::directory_iterator;
  for (Entries entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    const bool is_one = entry->path().extension() == ".json" && entry->is_regular_file(unknown);
    if (is_one) files.push_back(entry->path());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<std::filesystem::path> run_folders(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> runs;
  for (const std::filesystem::path& serial : folders_in(root)) {
    std::ranges::move(folders_in(serial), std::back_inserter(runs));
  }
  return runs;
}

std::string plan_name_in(const std::filesystem::path& run) {
  return text_in(json_in(run / "plan.json"), "name");
}

RigOfRun rig_of(const std::filesystem::path& run) {
  const nlohmann::json rig = json_in(run / "rig.json");
  const nlohmann::json asked = object_in(rig, "qualification");
  const nlohmann::json golden = object_in(asked, "golden_unit");
  return {text_in(rig, "rig"), text_in(asked, "station"), text_in(golden, "serial"),
          text_in(golden, "plan")};
}

std::string folder_name_of(const std::string& serial) {
  if (serial.empty()) throw std::invalid_argument("folder_name_of: serial is empty");
  std::string name = serial.substr(0, longest_name);
  std::ranges::replace_if(
      name, [](char c) { return !is_plain(c); }, '_');
  if (name.front() == '.' || name.front() == '-') name.front() = '_';
  for (const char* taken : {result_database_name, outbox_name, ledger_name}) {
    if (name.starts_with(taken)) name.front() = '_';  // SQLite adds -wal and -shm
  }
  if (name == limits_folder_name || name == qualification_folder_name) name.front() = '_';
  if (name != serial) name.append("-").append(sha256_of_text(serial), 0, 8);
  return name;
}

std::filesystem::path create_run_folder(const std::filesystem::path& root,
                                        const std::string& serial, const std::string& utc) {
  const std::filesystem::path parent = root / folder_name_of(serial);
  make_folders(parent);
  // Whoever made one that was there may have died before its name was on the disk.
  put_folder_on_disk(root);
  put_folder_on_disk(parent);
  std::filesystem::path folder = parent / utc;
  for (int copy = 2; !std::filesystem::create_directory(folder); ++copy) {
    folder = parent / fmt::format("{}-{}", utc, copy);
  }
  put_folder_on_disk(folder);
  return folder;
}

RunBegin next_run(const std::filesystem::path& root, const std::string& serial,
                  const std::string& utc) {
  RunBegin begin{serial, utc, 1};
  for (const auto& run : folders_in(root / folder_name_of(serial))) {
    begin.number = std::max(begin.number, read_run_begin(run).number + 1);
  }
  return begin;
}

std::string run_begin_to_json(const RunBegin& begin) {
  const nlohmann::ordered_json json{
      {"serial", begin.serial}, {"started_utc", begin.started_utc}, {"number", begin.number}};
  return json_text(json);
}

RunBegin read_run_begin(const std::filesystem::path& run) {
  RunBegin begin{run.parent_path().filename().string(), run.filename().string(), 0};
  const nlohmann::json json = json_in(run / "start.json");
  if (!json.is_object()) return begin;
  for (const auto& [key, value] :
       {std::pair{"serial", &begin.serial}, {"started_utc", &begin.started_utc}}) {
    if (std::string text = text_in(json, key); !text.empty()) *value = std::move(text);
  }
  if (json.contains("number") && json["number"].is_number_unsigned()) {
    begin.number = static_cast<int>(std::min(json["number"].get<std::uint64_t>(), most_runs));
  }
  return begin;
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
  std::vector<std::filesystem::path> runs = folders_in(root / folder_name_of(serial));
  std::erase_if(runs, [](const auto& run) {
    std::error_code unknown;  // what cannot be looked into is none to resume
    return !std::filesystem::exists(run / "plan.json", unknown) &&
           !std::filesystem::exists(run / "recording.h5", unknown);
  });
  if (runs.empty()) return std::nullopt;
  const auto newest = std::ranges::max_element(runs, {}, order_of);
  if (is_finished(*newest)) return std::nullopt;
  return *newest;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}{:02}{:02}T{:02}{:02}{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

}  // namespace rvbench::bench
