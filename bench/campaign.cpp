#include "bench/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/campaign_points.hpp"
#include "bench/campaign_source.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

constexpr int parts_of_one_file = 4;
constexpr double lead_in_s = 1;

struct Stretch : RecordLabels {
  double from_s = 0, to_s = 0;  // NaN: to the end
};

struct CampaignFile : CampaignSource {
  std::vector<Stretch> stretches = {};
};

CampaignRecord cut(const Recording& whole, const Stretch& stretch) {
  CampaignRecord record{stretch, 0, {}};
  const double rate_Hz = whole.channels.front().rate_Hz;
  const Eigen::Index size = whole.channels.front().samples.size();
  const auto from =
      std::min(size, static_cast<Eigen::Index>(std::llround(stretch.from_s * rate_Hz)));
  const auto to = std::min(size, static_cast<Eigen::Index>(std::llround(stretch.to_s * rate_Hz)));
  record.lead_in = std::min(from, static_cast<Eigen::Index>(std::llround(lead_in_s * rate_Hz)));
  const Eigen::Index first = from - record.lead_in;
  record.recording = whole;
  for (Channel& channel : record.recording.channels) {
    channel.samples =
        Eigen::VectorXd(channel.samples.segment(first, std::max<Eigen::Index>(to - first, 0)));
    channel.start_s += static_cast<double>(first) / rate_Hz;
  }
  return record;
}

double length_s(const Recording& recording) {
  const Channel& first = recording.channels.front();
  return static_cast<double>(first.samples.size()) / first.rate_Hz;
}

std::vector<Stretch> equal_parts(const std::string& name, double whole_s, int parts) {
  std::vector<Stretch> stretches;
  for (int i = 0; i < parts; ++i) {
    const std::string part =
        parts == 1 ? name : fmt::format("{}, part {} of {}", name, i + 1, parts);
    stretches.push_back(
        {{part, part, "", "", "", true}, whole_s * i / parts, whole_s * (i + 1) / parts});
  }
  return stretches;
}

std::string stretch_fault(const Stretch& stretch, double whole_s) {
  if (stretch.to_s > stretch.from_s && stretch.to_s <= whole_s * (1 + 1e-9) + 1e-9) return {};
  return fmt::format("{} to {} s is no stretch of a recording of {:.6g} s", stretch.from_s,
                     stretch.to_s, whole_s);
}

// Stretches of one file that share samples, one of them learned from and the other left out of it.
std::string overlap_fault(const std::vector<Stretch>& stretches) {
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Stretch &a = stretches[i], &b = stretches[k];
      const bool apart = a.to_s <= b.from_s || b.to_s <= a.from_s;
      const bool alike =
          a.learned_from == b.learned_from && (!a.learned_from || a.condition == b.condition);
      if (apart || alike) continue;
      return fmt::format("\"{}\" and \"{}\" share samples: what is left out would be known", b.name,
                         a.name);
    }
  }
  return {};
}

// `wanted`, or "wanted (2)" ...: the first that no record has.
std::string free_name(const Campaign& campaign, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2;
       std::ranges::find(campaign.records, name, &CampaignRecord::name) != campaign.records.end();
       ++i) {
    name = fmt::format("{} ({})", wanted, i);
  }
  return name;
}

// Adds the stretches of one recording. @return why not; "" if it did
std::string add_stretches(Campaign& campaign, const Recording& recording,
                          std::vector<Stretch> stretches) {
  const double whole_s = length_s(recording);
  for (Stretch& stretch : stretches) {
    if (std::isnan(stretch.to_s)) stretch.to_s = whole_s;
  }
  std::string fault = overlap_fault(stretches);
  if (!fault.empty()) return fault;
  for (const Stretch& stretch : stretches) {
    fault = stretch_fault(stretch, whole_s);
    if (!fault.empty()) return fault;
    add_record(campaign, cut(recording, stretch));
  }
  return {};
}

// Adds one file's records. @return why not; "" if it did
std::string add_file(Campaign& campaign, const CampaignFile& file,
                     const std::vector<std::string>& wanted, int parts) {
  const auto hash = sha256_of_file(file.path);
  for (const auto& [other, known] : campaign.hashes) {
    if (hash == known) return file.path + ": the same recording as " + other;
  }
  if (hash) campaign.hashes.emplace_back(file.path, *hash);
  auto read = read_source(file, wanted, campaign.notes);
  if (const auto* fault = std::get_if<std::string>(&read)) return *fault;
  const std::size_t before = campaign.records.size();
  for (Recording& recording : std::get<0>(read)) {
    if (file.stretches.empty() && is_point(recording)) {
      add_point(campaign, std::move(recording));
      continue;
    }
    const std::string name =
        free_name(campaign, std::filesystem::path(recording.source).filename().string());
    const std::string fault = add_stretches(
        campaign, recording,
        file.stretches.empty() ? equal_parts(name, length_s(recording), parts) : file.stretches);
    if (!fault.empty()) return file.path + ": " + fault;
  }
  return campaign.records.size() > before ? "" : file.path + ": none of its points can be used";
}

Stretch parse_stretch(hal::ConfigReader& json, const std::string& file) {
  Stretch stretch;
  stretch.from_s = json.number("from_s", {0, 1e7}, 0);
  stretch.to_s = json.number("to_s", {0, 1e7}, not_known);
  stretch.condition = json.text(
      "condition", std::isnan(stretch.to_s)
                       ? file
                       : fmt::format("{}, {:g} to {:g} s", file, stretch.from_s, stretch.to_s));
  stretch.name = json.text("name", stretch.condition);
  stretch.speed = json.text("speed", "");
  stretch.load = json.text("load", "");
  stretch.programme = json.text("programme", "");
  stretch.learned_from = json.choice("use", {"learn", "predict"}, "learn") == "learn";
  return stretch;
}

CampaignFile parse_file(hal::ConfigReader& json, const std::filesystem::path& folder) {
  CampaignFile file{parse_source(json, folder)};
  const std::string name = json.text("file", "");
  for (hal::ConfigReader& record : json.objects("records", false)) {
    file.stretches.push_back(parse_stretch(record, name));
  }
  return file;
}

CampaignOrRefusal whole(Campaign campaign, std::vector<hal::ConfigFault> faults) {
  if (!faults.empty()) return Refusal{std::move(faults), true};
  return campaign;
}

}  // namespace

void add_record(Campaign& campaign, CampaignRecord record) {
  record.name = free_name(campaign, record.name);
  campaign.records.push_back(std::move(record));
}

CampaignOrRefusal read_campaign(const std::string& path, const std::vector<std::string>& wanted) {
  hal::ConfigReader root = hal::ConfigReader::from_file(path);
  Campaign campaign;
  campaign.name = root.text("campaign");
  std::vector<CampaignFile> files;
  for (hal::ConfigReader& json : root.objects("files")) {
    files.push_back(parse_file(json, std::filesystem::path(path).parent_path()));
  }
  if (files.empty() && root.has("files")) root.fault("files", "names no recording");
  root.finish();
  if (!root.faults().empty()) return Refusal{root.faults(), false};
  std::vector<hal::ConfigFault> faults;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string fault =
        add_file(campaign, files[i], wanted, files.size() == 1 ? parts_of_one_file : 1);
    if (!fault.empty()) faults.push_back({0, fmt::format("/files/{}", i), fault});
  }
  return whole(std::move(campaign), std::move(faults));
}

CampaignOrRefusal campaign_of(const std::vector<std::string>& files, double rate_Hz,
                              const std::vector<std::string>& wanted) {
  Campaign campaign;
  std::vector<hal::ConfigFault> faults;
  for (const std::string& file : files) {
    campaign.name +=
        (campaign.name.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
    const std::string fault =
        add_file(campaign, {{file, rate_Hz}}, wanted, files.size() == 1 ? parts_of_one_file : 1);
    if (!fault.empty()) faults.push_back({0, "", fault});
  }
  return whole(std::move(campaign), std::move(faults));
}

}  // namespace rvbench::bench
