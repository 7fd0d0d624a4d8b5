#include "bench/limits_versions.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* folder_name = "limits";
constexpr const char* suffix = ".json";

std::vector<std::filesystem::path> files_in(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> files;
  std::error_code error;  // what cannot be looked into holds none
  using Entries = std::filesystem::directory_iterator;
  for (Entries entry(root / folder_name, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unknown;
    const bool is_one = entry->path().extension() == suffix && entry->is_regular_file(unknown);
    if (is_one) files.push_back(entry->path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

bool is_limits_version(const std::string& version) {
  return !version.empty() && folder_name_of(version) == version;
}

std::filesystem::path limits_path(const std::filesystem::path& root, const std::string& version) {
  return root / folder_name / (version + suffix);
}

std::vector<LimitsFile> limits_versions(const std::filesystem::path& root) {
  std::vector<LimitsFile> versions;
  for (const std::filesystem::path& file : files_in(root)) {
    auto read = read_limits_file(file);
    if (read.index() == 0) versions.push_back(std::get<0>(std::move(read)));
  }
  return versions;
}

const LimitsStep* last_step(const LimitsFile& file, const std::string& step) {
  const auto found =
      std::ranges::find(file.steps.rbegin(), file.steps.rend(), step, &LimitsStep::step);
  return found == file.steps.rend() ? nullptr : &*found;
}

std::string status_of(const LimitsFile& file) {
  if (file.steps.empty() || file.steps.back().limits_sha256 != limits_hash(file.limits)) {
    return "draft";
  }
  const LimitsStep* approved = last_step(file, "approved");
  if (approved == nullptr || approved->limits_sha256 != limits_hash(file.limits)) return "draft";
  return file.steps.back().step == "activated" ? "activated" : "approved";
}

std::variant<std::optional<LimitsFile>, std::string> active_limits(
    const std::filesystem::path& root, const std::string& plan) {
  std::optional<LimitsFile> active;
  for (const std::filesystem::path& file : files_in(root)) {
    auto read = read_limits_file(file);
    if (read.index() == 1) {
      return file.string() + " cannot be read: rvbench check tells why";
    }
    LimitsFile& version = std::get<0>(read);
    const LimitsStep* step = last_step(version, "activated");
    if (version.plan != plan || step == nullptr) continue;
    if (active && last_step(*active, "activated")->utc > step->utc) continue;
    active = std::move(version);
  }
  if (active && status_of(*active) != "activated") {
    return "limits " + active->version +
           " were changed since they were approved: approve and activate them again";
  }
  return active;
}

}  // namespace rvbench::bench
