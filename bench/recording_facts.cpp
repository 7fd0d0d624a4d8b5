#include "bench/recording_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "analysis/quality.hpp"
#include "bench/no_accelerations.hpp"
#include "hal/formats/choose_format.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t most_names = 12;

// "2 channels (a [m/s²], b)"
std::string channels_of(const Recording& record) {
  const std::size_t count = record.channels.size();
  std::string names;
  for (std::size_t i = 0; i < std::min(count, most_names); ++i) {
    const ChannelInfo& info = record.channels[i].info;
    names += (i > 0 ? ", " : "") + info.name + (info.unit.empty() ? "" : " [" + info.unit + "]");
  }
  if (count > most_names) names += fmt::format(" and {} more", count - most_names);
  return fmt::format("{} {} ({})", count, count == 1 ? "channel" : "channels", names);
}

// "8000 samples at 2000 Hz: 4 s", of the channel that has most.
std::string length_of(const Recording& record) {
  const Channel& longest = *std::ranges::max_element(
      record.channels, {}, [](const Channel& channel) { return channel.samples.size(); });
  const Eigen::Index count = longest.samples.size();
  const std::string samples = fmt::format("{} sample{}", count, count == 1 ? "" : "s");
  if (!(longest.rate_Hz > 0)) return samples + " at a rate that it does not state";
  return fmt::format("{} at {:.6g} Hz: {:.6g} s", samples, longest.rate_Hz,
                     static_cast<double>(count) / longest.rate_Hz);
}

// What spoils a channel, whatever its rate.
void add_warnings(const Recording& record, std::vector<std::string>& warnings) {
  for (const Channel* channel : analysis::acceleration_channels(record)) {
    Channel rated = *channel;
    rated.rate_Hz = std::max(rated.rate_Hz, 1.0);
    for (const analysis::QualityNote& note : analysis::channel_quality(rated, not_known)) {
      warnings.push_back(note.where + ": " + note.what);
    }
  }
}

}  // namespace

bool is_recording(const std::filesystem::path& file) {
  if (file.extension() == ".json" || hal::formats::find_obstacle(file)) return false;
  if (!hal::formats::choose_format(file)) return false;
  char first = ' ';
  std::ifstream(file) >> first;
  return first != '{' && first != '[';
}

std::variant<RecordingFacts, std::string> recording_facts(const std::filesystem::path& file) {
  auto read = hal::read_recordings(file);
  if (!read) return read.error().where;
  Recording first = std::move(read.value().front());
  RecordingFacts facts;
  const std::size_t count = read.value().size();
  const std::string_view format = hal::formats::choose_format(file)->name;
  facts.summary = fmt::format("{}, {}{}, {}", format,
                              count > 1 ? fmt::format("{} recordings, the first of ", count) : "",
                              channels_of(first), length_of(first));
  if (first.status != "ok" && !first.status.empty()) facts.warnings.push_back(first.status);
  if (const auto refused = leave_out_what_is_no_acceleration("", first)) {
    facts.warnings.push_back("judge refuses it: " + *refused);
  }
  if (analysis::acceleration_channels(first).empty()) {
    facts.warnings.push_back("judge refuses it: no acceleration channel");
  }
  add_warnings(first, facts.warnings);
  facts.notes = std::move(first.notes);
  return facts;
}

}  // namespace rvbench::bench
