#include "bench/campaign_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/campaign_points.hpp"
#include "bench/lost_rows.hpp"
#include "bench/text_file.hpp"
#include "bench/uniform_time.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

constexpr hal::Bounds any{-1e300, 1e300};
constexpr std::string_view own_time_column = "time_s";
constexpr double one_rate = 1e-3;  // relative: less is the same

auto read_file(const std::string& path, const CampaignSource& as) {
  return hal::read_recordings(path, {as.time_column.empty() ? as.rate_Hz : not_known, not_known});
}

// Names the columns; a fault if their number is another.
std::string name_columns(Recording& recording, const std::vector<std::string>& columns) {
  if (columns.empty()) return {};
  if (columns.size() != recording.channels.size()) {
    return fmt::format("{} columns are named, the file has {}", columns.size(),
                       recording.channels.size());
  }
  for (std::size_t i = 0; i < columns.size(); ++i) recording.channels[i].info.name = columns[i];
  return {};
}

bool is_one_rate(double rate_Hz, double other_Hz) {
  return std::abs(rate_Hz / other_Hz - 1) < one_rate;
}

// The column of time stamps: the one that is named or else time_s, which is what rvbench calls it.
// Where a rate is stated for the file that goes before the one of time_s, but not before its gaps.
std::string time_column_of(const Recording& recording, const CampaignSource& source) {
  const Channel* own = recording.find(own_time_column);
  if (!source.time_column.empty() || own == nullptr) return source.time_column;
  if (std::isnan(source.rate_Hz)) return std::string(own_time_column);
  const auto made = uniform_time(own->samples, not_known);
  const auto* time = std::get_if<UniformTime>(&made);
  const bool used = time == nullptr ? find_lost_rows(own->samples).has_value()
                                    : is_one_rate(time->rate_Hz, source.rate_Hz);
  return used ? std::string(own_time_column) : "";
}

// Says where a rate that was stated is not the one of a column time_s.
void note_other_rate(const Recording& recording, const CampaignSource& source,
                     std::vector<std::string>& notes) {
  const Channel* stamps = recording.find(own_time_column);
  if (stamps == nullptr || std::isnan(source.rate_Hz)) return;
  const auto made = uniform_time(stamps->samples, not_known);
  const auto* time = std::get_if<UniformTime>(&made);
  if (time == nullptr || is_one_rate(time->rate_Hz, source.rate_Hz)) return;
  notes.push_back(
      fmt::format("{}: taken at {:.6g} Hz as stated, where its column {} says {:.6g} Hz",
                  source.path, source.rate_Hz, own_time_column, time->rate_Hz));
}

// Takes the time column out and puts the others on uniform times.
std::string use_time_column(Recording& recording, const CampaignSource& source,
                            std::vector<std::string>& notes) {
  const std::string name = time_column_of(recording, source);
  if (name.empty()) {
    note_other_rate(recording, source, notes);
    return {};
  }
  const Channel* stamps = recording.find(name);
  if (stamps == nullptr) return "there is no column " + hal::in_quotes(name);
  const Eigen::VectorXd time_s = stamps->samples;
  const auto made = uniform_time(time_s, source.rate_Hz);
  if (const auto* fault = std::get_if<std::string>(&made)) return *fault;
  const UniformTime& time = std::get<UniformTime>(made);
  std::erase_if(recording.channels, [&](const Channel& channel) {
    return channel.info.name == name || channel.samples.size() != time_s.size();
  });
  for (Channel& channel : recording.channels) {
    channel.rate_Hz = time.rate_Hz;
    channel.start_s = 0;
    if (time.resampled) channel.samples = resampled(time_s, channel.samples, time);
  }
  if (time.resampled) {
    notes.push_back(
        fmt::format("{}: time stamps are not uniform (up to {:.3g} s apart): resampled "
                    "at {:.6g} Hz on straight lines",
                    source.path, time.worst_gap_s, time.rate_Hz));
  }
  return {};
}

std::string put_in_order(Recording& recording, const CampaignSource& source,
                         const std::vector<std::string>& wanted, std::vector<std::string>& notes) {
  std::string fault = name_columns(recording, source.columns);
  if (fault.empty()) fault = use_time_column(recording, source, notes);
  return fault.empty() ? keep_one_clock(recording, wanted) : fault;
}

std::string find_speed(Recording& recording, const CampaignSource& source,
                       std::vector<std::string>& notes) {
  if (!source.vibration_speed) return {};
  const VibrationSpeed& how = *source.vibration_speed;
  if (how.relative_to.empty()) return use_vibration_speed(recording, nullptr, how, notes);
  auto read = read_file(how.relative_to, source);
  if (!read) return read.error().where;
  Recording reference = std::move(read).value().front();
  const std::string fault = put_in_order(reference, source, {}, notes);
  return fault.empty() ? use_vibration_speed(recording, &reference, how, notes)
                       : how.relative_to + ": " + fault;
}

std::string add_constants(Recording& recording, const std::vector<ConstantChannel>& constants,
                          std::vector<std::string>& notes) {
  const Channel first = recording.channels.front();
  if (!(first.rate_Hz > 0)) return "states no sample rate: give rate_Hz, or --rate HZ";
  for (const ConstantChannel& constant : constants) {
    if (recording.find(constant.name) != nullptr) {
      return "has a channel " + hal::in_quotes(constant.name) + " of its own";
    }
    Channel channel = first;
    channel.info = {constant.name, constant.unit, "", not_known};
    channel.samples.setConstant(constant.value);
    recording.channels.push_back(std::move(channel));
    notes.push_back(fmt::format("{}: {} is stated as {:g} {}, not measured",
                                std::filesystem::path(recording.source).filename().string(),
                                constant.name, constant.value, constant.unit));
  }
  return {};
}

}  // namespace

CampaignSource parse_source(hal::ConfigReader& json, const std::filesystem::path& folder) {
  CampaignSource source;
  source.path = (folder / json.text("file")).string();
  if (json.has("rate_Hz")) source.rate_Hz = json.number("rate_Hz", {1e-3, 1e8});
  source.time_column = json.text("time_column", "");
  if (json.has("columns")) source.columns = json.texts("columns");
  if (auto speed = json.optional_object("speed_from_vibration")) {
    source.vibration_speed = parse_vibration_speed(*speed, folder);
  }
  if (auto constants = json.optional_object("constants")) {
    for (auto& [name, constant] : constants->members()) {
      source.constants.push_back({name, constant.text("unit"), constant.number("value", any)});
    }
  }
  return source;
}

// Channels of another length are scalars among the variables, or on another clock.
std::string keep_one_clock(Recording& recording, const std::vector<std::string>& wanted) {
  Eigen::Index length = 0;
  for (const std::string& name : wanted) {
    const Channel* channel = recording.find(name);
    if (length == 0 && channel != nullptr) length = channel->samples.size();
  }
  if (length == 0) {
    for (const Channel& channel : recording.channels) {
      length = std::max(length, channel.samples.size());
    }
  }
  std::erase_if(recording.channels,
                [&](const Channel& channel) { return channel.samples.size() != length; });
  return length < 2 ? "has no channel of at least 2 samples" : "";
}

std::variant<std::vector<Recording>, std::string> read_source(
    const CampaignSource& source, const std::vector<std::string>& wanted,
    std::vector<std::string>& notes) {
  auto read = read_file(source.path, source);
  if (!read) return read.error().where;
  std::vector<Recording> recordings = std::move(read).value();
  for (Recording& recording : recordings) {
    if (has_no_sound_end(recording)) continue;
    std::string fault = put_in_order(recording, source, wanted, notes);
    if (fault.empty()) fault = find_speed(recording, source, notes);
    if (fault.empty()) fault = add_constants(recording, source.constants, notes);
    if (!fault.empty()) return fmt::format("{}: {}", source.path, fault);
  }
  return recordings;
}

}  // namespace rvbench::bench
