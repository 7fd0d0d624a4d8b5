#include "bench/qualification/golden_runs.hpp"

#include <algorithm>
#include <system_error>

#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* start_file = "start.json";
constexpr const char* ended_kind = "golden run ended";

// What the kind of a begin has before the plan's hash.
std::string kind_before(const QualificationSection& section) {
  return "golden run begun on a rig of kind " + section.rig_kind + ", plan " +
         section.golden_unit->plan + " with the hash ";
}

bool is_golden(const QualificationSection* section, const std::filesystem::path& run) {
  return section != nullptr && section->golden_unit &&
         section->golden_unit->serial == read_run_begin(run).serial &&
         section->golden_unit->plan == plan_name_in(run);
}

std::string file_of(const std::filesystem::path& root, const std::filesystem::path& run,
                    const char* name) {
  return (run.lexically_relative(root) / name).string();
}

std::string why_not(const std::system_error& error) {
  return "the golden unit's run cannot be entered into the ledger: " + reason_of(error);
}

}  // namespace

std::string enter_golden_begin(const std::filesystem::path& root,
                               const QualificationSection* section,
                               const std::filesystem::path& run, const std::string& plan_sha256) {
  if (!is_golden(section, run)) return "";
  try {
    LedgerPen(root).enter(kind_before(*section) + plan_sha256, section->station,
                          file_of(root, run, start_file));
    return "";
  } catch (const std::system_error& error) {
    return why_not(error);
  }
}

std::string enter_golden_end(const std::filesystem::path& root, const QualificationSection* section,
                             const std::filesystem::path& run) {
  if (!is_golden(section, run)) return "";
  try {
    LedgerPen pen(root);
    const Ledger ledger = read_ledger(root);
    const bool has_begun = ledger.last_of(file_of(root, run, start_file)) != nullptr;
    if (ledger.fault.empty() && !has_begun) return "";
    pen.enter(ended_kind, section->station, file_of(root, run, "verdict.json"));
    return "";
  } catch (const std::system_error& error) {
    return why_not(error);
  }
}

std::vector<GoldenLines> golden_lines(const Ledger& ledger, const QualificationSection& section) {
  const std::string unit = folder_name_of(section.golden_unit->serial) + "/";
  const std::string begun = kind_before(section);
  std::vector<GoldenLines> runs;
  for (const LedgerLine& line : ledger.lines) {
    if (line.of != section.station || !line.file.starts_with(unit)) continue;
    const std::string folder = std::filesystem::path(line.file).parent_path().string();
    const auto run = std::find_if(runs.rbegin(), runs.rend(),
                                  [&](const GoldenLines& there) { return there.folder == folder; });
    const bool begins = line.kind.starts_with(begun);
    if (run != runs.rend()) {
      if (begins) run->ended = nullptr;  // gone on with
      if (line.kind == ended_kind) run->ended = &line;
    } else if (begins) {
      runs.push_back({folder, line.kind.substr(begun.size()), &line, nullptr});
    }
  }
  const auto before = std::find_if(runs.rbegin(), runs.rend(), [&](const GoldenLines& run) {
    return run.begun->utc < section.golden_unit->since_utc;
  });
  runs.erase(runs.begin(), before.base());
  return runs;
}

}  // namespace rvbench::bench
