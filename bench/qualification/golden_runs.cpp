#include "bench/qualification/golden_runs.hpp"

#include <algorithm>

#include "bench/run_folder.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* start_file = "start.json";
constexpr const char* verdict_file = "verdict.json";

std::string kind_of(const char* step, const QualificationSection& section) {
  return std::string("golden run ") + step + ", plan " + section.golden_unit->plan +
         ", a rig of kind " + section.rig_kind;
}

}  // namespace

bool is_golden_run(const QualificationSection& section, const std::string& serial,
                   const std::string& plan) {
  const auto& golden = section.golden_unit;
  return golden && golden->serial == serial && golden->plan == plan;
}

// One that is resumed has its line.
void enter_golden_begin(const std::filesystem::path& root, const QualificationSection& section,
                        const std::filesystem::path& run) {
  const std::string file = (run.lexically_relative(root) / start_file).string();
  LedgerPen pen(root);
  if (read_ledger(root).last_of(file) != nullptr) return;
  pen.enter(kind_of("begun", section), section.station, file);
}

void enter_golden_end(const std::filesystem::path& root, const QualificationSection& section,
                      const std::filesystem::path& run) {
  const std::filesystem::path folder = run.lexically_relative(root);
  LedgerPen pen(root);
  if (read_ledger(root).last_of((folder / start_file).string()) == nullptr) return;
  pen.enter(kind_of("ended", section), section.station, (folder / verdict_file).string());
}

std::vector<GoldenLines> golden_lines(const Ledger& ledger, const QualificationSection& section) {
  const std::string unit = folder_name_of(section.golden_unit->serial) + "/";
  const std::string begun = kind_of("begun", section), ended = kind_of("ended", section);
  std::vector<GoldenLines> runs;
  for (const LedgerLine& line : ledger.lines) {
    if (line.of != section.station || !line.file.starts_with(unit)) continue;
    const std::string folder = std::filesystem::path(line.file).parent_path().string();
    if (line.kind == begun && (!runs.empty() || line.utc >= section.golden_unit->since_utc)) {
      runs.push_back({folder, &line, nullptr});
    }
    const auto run = std::ranges::find(runs, folder, &GoldenLines::folder);
    if (line.kind == ended && run != runs.end()) run->ended = &line;
  }
  return runs;
}

}  // namespace rvbench::bench
