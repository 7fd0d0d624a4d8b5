#include "bench/serve/known_runs.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

std::string verdict_in(const std::filesystem::path& folder) {
  const auto json =
      nlohmann::json::parse(read_file(folder / "verdict.json").value_or(""), nullptr, false);
  if (!json.is_object() || !json.contains("verdict") || !json["verdict"].is_string()) return "";
  return json["verdict"].get<std::string>();
}

}  // namespace

std::vector<KnownRun> known_runs(const std::filesystem::path& root, const std::string& serial) {
  std::vector<KnownRun> runs;
  std::error_code none;
  using Entries = std::filesystem::directory_iterator;
  for (Entries entry(root / folder_name_of(serial), none), end; !none && entry != end;
       entry.increment(none)) {
    std::error_code unknown;
    if (!std::filesystem::exists(entry->path() / "start.json", unknown)) continue;
    const RunBegin begin = read_run_begin(entry->path());
    const auto run = entry->path().parent_path().filename() / entry->path().filename();
    runs.push_back({run.string(), begin.started_utc, verdict_in(entry->path()), begin.number});
  }
  std::ranges::sort(runs, {}, &KnownRun::number);
  return runs;
}

}  // namespace rvbench::bench
