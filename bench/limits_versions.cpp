#include "bench/limits_versions.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* suffix = ".json";

std::string below_root(const std::string& version) {
  return std::string(limits_folder_name) + "/" + version + suffix;
}

constexpr const char* remedy = ": put back a copy, or approve and activate limits again";

std::string kind_of(const std::string& step) { return "limits " + step; }

std::vector<std::string> versions_in(const std::filesystem::path& root) {
  std::vector<std::string> versions;
  for (const std::filesystem::path& file : json_files_in(root / limits_folder_name)) {
    versions.push_back(file.stem().string());
  }
  return versions;
}

// By what the file says of itself.
std::string status_by_steps(const LimitsFile& file) {
  const std::string now = limits_hash(file.limits);
  const auto is_of_now = [&](const char* name) {
    const LimitsStep* step = last_step(file, name);
    return step != nullptr && step->limits_sha256 == now;
  };
  if (!is_of_now("approved")) return "draft";
  return is_of_now("activated") ? "activated" : "approved";
}

// "" if it is as it was kept.
std::string fault_in(const Ledger& ledger, const std::filesystem::path& root,
                     const std::string& version) {
  const LedgerLine* line = ledger.last_of(below_root(version));
  return line != nullptr ? fault_of(root, *line) : limits_path(root, version).string() + in_no_line;
}

// Of all files but that in force one that is not as it was kept, and may be what is in force: a
// ledger may be gone, or lack its newest lines.
std::string doubtful_active(const Ledger& ledger, const std::filesystem::path& root,
                            const std::string& plan, const std::string& in_force) {
  for (const std::string& version : versions_in(root)) {
    const std::string fault = fault_in(ledger, root, version);
    if (fault.empty() || below_root(version) == in_force) continue;
    const auto read = read_limits_file(limits_path(root, version));
    if (read.index() == 1) {
      if (ledger.last_of(below_root(version)) == nullptr) return fault + ": take it away";
      continue;  // its lines tell what it was
    }
    const LimitsFile& file = std::get<0>(read);
    if (file.plan == plan && last_step(file, "activated") != nullptr) {
      return fault + "; it says that it is active for plan " + plan + remedy;
    }
  }
  return "";
}

// By plan the file that was activated last.
std::map<std::string, std::string> files_in_force(const Ledger& ledger) {
  std::map<std::string, std::string> file_by_plan;
  for (const LedgerLine& line : ledger.lines) {
    if (line.kind == kind_of("activated")) file_by_plan[line.of] = line.file;
  }
  return file_by_plan;
}

LimitsVersion version_of(const Ledger& ledger, const std::filesystem::path& root,
                         const std::string& name) {
  const std::filesystem::path path = limits_path(root, name);
  LimitsVersion version{name, {}, "damaged", false, fault_in(ledger, root, name)};
  auto read = read_limits_file(path);
  if (read.index() == 1) {
    version.fault = path.string() + " cannot be read: rvbench check tells why";
    return version;
  }
  version.file = std::get<0>(std::move(read));
  version.status = version.fault.empty() ? status_by_steps(version.file) : "draft";
  return version;
}

}  // namespace

bool is_limits_version(const std::string& version) {
  return !version.empty() && folder_name_of(version) == version;
}

std::filesystem::path limits_path(const std::filesystem::path& root, const std::string& version) {
  return root / below_root(version);
}

const LimitsStep* last_step(const LimitsFile& file, const std::string& step) {
  const auto found =
      std::ranges::find(file.steps.rbegin(), file.steps.rend(), step, &LimitsStep::step);
  return found == file.steps.rend() ? nullptr : &*found;
}

std::vector<LimitsVersion> limits_versions(const std::filesystem::path& root) {
  const LedgerReading reading(root);
  const Ledger ledger = read_ledger(root);
  const std::vector<std::string> names = versions_in(root);
  std::vector<LimitsVersion> versions;
  for (const std::string& name : names) versions.push_back(version_of(ledger, root, name));
  for (const auto& [plan, file] : files_in_force(ledger)) {
    const std::string name = std::filesystem::path(file).stem().string();
    const auto found = std::ranges::find(versions, name, &LimitsVersion::version);
    if (found != versions.end()) {
      found->is_in_force = true;
    } else {
      versions.push_back({name, {}, "missing", true, root.string() + "/" + file + " is missing"});
    }
  }
  return versions;
}

std::string status_of(const LimitsFile& file, const std::filesystem::path& root) {
  const bool is_kept = fault_in(read_ledger(root), root, file.version).empty();
  return is_kept ? status_by_steps(file) : "draft";
}

std::variant<std::optional<LimitsFile>, std::string> active_limits(
    const std::filesystem::path& root, const std::string& plan) {
  const LedgerReading reading(root);
  const Ledger ledger = read_ledger(root);
  if (!ledger.fault.empty()) return ledger.fault + ": put back a copy";
  const auto in_force = files_in_force(ledger);
  const auto found = in_force.find(plan);
  const std::string name = found == in_force.end() ? "" : found->second;
  if (std::string doubt = doubtful_active(ledger, root, plan, name); !doubt.empty()) return doubt;
  if (name.empty()) return std::optional<LimitsFile>();
  const std::string fault = fault_of(root, *ledger.last_of(name));
  if (!fault.empty()) return "of the limits in force for plan " + plan + ", " + fault + remedy;
  auto read = read_limits_file(root / name);
  if (read.index() == 1) return (root / name).string() + " cannot be read" + remedy;
  LimitsFile& file = std::get<0>(read);
  if (file.plan != plan) {
    return "limits " + file.version + " were in force for plan " + plan + ", and are now of plan " +
           file.plan + remedy;
  }
  if (status_by_steps(file) != "activated") {
    return "limits " + file.version + " were changed since they were approved" + remedy;
  }
  return std::optional<LimitsFile>(std::move(file));
}

bool was_kept(const std::filesystem::path& root, const std::string& version) {
  return read_ledger(root).last_of(below_root(version)) != nullptr;
}

std::set<std::string> activated_versions(const std::filesystem::path& root) {
  std::set<std::string> versions;
  for (const LedgerLine& line : read_ledger(root).lines) {
    if (line.kind == kind_of("activated")) {
      versions.insert(std::filesystem::path(line.file).stem().string());
    }
  }
  return versions;
}

void keep_limits(LedgerPen& pen, const LimitsFile& file) {
  pen.keep(kind_of(file.steps.back().step), file.plan, below_root(file.version),
           limits_file_to_json(file));
}

}  // namespace rvbench::bench
