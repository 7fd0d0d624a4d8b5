#include "bench/campaign_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/campaign_source.hpp"
#include "bench/file_kind.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_recordings.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

Refusal refused(const std::filesystem::path& folder, const std::string& why) {
  return {{{0, "", folder.string() + ": " + why}}, true};
}

}  // namespace

bool is_point(const Recording& recording) {
  return std::isfinite(recording.planned_speed_rpm) && std::isfinite(recording.load_pct);
}

bool has_no_sound_end(const Recording& recording) {
  return is_point(recording) && recording.status != "ok";
}

void add_point(Campaign& campaign, Recording point) {
  CampaignRecord record;
  record.speed = fmt::format("{:g} rpm", point.planned_speed_rpm);
  record.load = fmt::format("{:g} %", point.load_pct);
  record.condition = record.speed + ", " + record.load;
  record.programme = record.condition;
  record.name = point.repeat > 0 ? fmt::format("{}, repeat {}", record.condition, point.repeat)
                                 : record.condition;
  if (has_no_sound_end(point)) {
    campaign.notes.push_back(fmt::format("{} is left out: {}", record.name, point.status));
    return;
  }
  record.recording = std::move(point);
  add_record(campaign, std::move(record));
}

std::vector<std::string> run_faults(const std::filesystem::path& folder) {
  if (is_absent(folder)) return {"there is no such folder"};
  if (is_absent(folder / "plan.json")) return {"no run folder: it holds no plan.json"};
  if (!is_finished(folder)) {
    return {"the run has not come to its end: rvbench run --resume goes on with it"};
  }
  constexpr std::array own{"explain.json:", "explain.html:", "plant_updated.json:"};
  std::vector<std::string> faults = verify_sums(folder);
  std::erase_if(faults, [&](const std::string& fault) {
    return std::ranges::any_of(own, [&](const char* name) { return fault.starts_with(name); });
  });
  return faults;
}

CampaignOrRefusal campaign_of_run(const std::filesystem::path& folder,
                                  const std::vector<std::string>& wanted) {
  Result<RunRecordings> opened = RunRecordings::open(folder);
  if (!opened) return refused(folder, describe(opened.error()));
  RunRecordings run = std::move(opened).value();
  Campaign campaign;
  campaign.name = folder.string();
  for (const std::string& name : recording_names(folder)) {
    const std::string file = (folder / name).string();
    campaign.hashes.emplace_back(file, sha256_of_file(file).value_or(""));
  }
  for (int number = 0; number < run.points(); ++number) {
    if (!run.has(number)) continue;
    Result<Recording> point = run.read(number);
    if (!point) return refused(folder, describe(point.error()));
    Recording recording = std::move(point).value();
    const std::string fault = has_no_sound_end(recording) ? "" : keep_one_clock(recording, wanted);
    if (!fault.empty()) return refused(folder, fmt::format("point {:03} {}", number, fault));
    add_point(campaign, std::move(recording));
  }
  if (campaign.records.empty()) return refused(folder, "none of its points can be used");
  return campaign;
}

}  // namespace rvbench::bench
