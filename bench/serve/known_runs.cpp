#include "bench/serve/known_runs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/json_text.hpp"
#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

std::string verdict_in(const std::filesystem::path& folder) {
  const auto json = json_or_discarded(read_file(folder / "verdict.json").value_or(""));
  if (!json.is_object() || !json.contains("verdict") || !json["verdict"].is_string()) return "";
  return json["verdict"].get<std::string>();
}

}  // namespace

std::vector<KnownRun> known_runs(const std::filesystem::path& root, const std::string& serial) {
  std::vector<KnownRun> runs;
  for (const std::filesystem::path& folder : folders_in(root / folder_name_of(serial))) {
    std::error_code unknown;
    if (!std::filesystem::exists(folder / "start.json", unknown)) continue;
    const RunBegin begin = read_run_begin(folder);
    const auto run = folder.parent_path().filename() / folder.filename();
    runs.push_back({run.string(), begin.started_utc, verdict_in(folder), begin.number});
  }
  std::ranges::sort(runs, {}, &KnownRun::number);
  return runs;
}

}  // namespace rvbench::bench
