#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hal/formats/apply_units.hpp"
#include "hal/formats/facts.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/start_time.hpp"
#include "hal/formats/tdms_file.hpp"
#include "hal/formats/tdms_scaling.hpp"

namespace rvbench::hal::formats {
namespace {

bool is_tdms(std::string_view head) { return head.starts_with("TDSm") || head.starts_with("TDSh"); }

// A waveform over something else than time is a spectrum, say.
bool is_over_time(const TdmsChannel& channel) {
  const std::string unit = text_in(channel.properties, "wf_xunit_string");
  return unit.empty() || unit == "s" || unit == "sec" || unit == "Seconds";
}

std::string unit_text(const TdmsChannel& channel) {
  for (const char* property : {"unit_string", "NI_UnitDescription"}) {
    const std::string unit = text_in(channel.properties, property);
    if (!unit.empty()) return unit;
  }
  return channel.is_time ? "s" : "";
}

Facts facts_in(const TdmsProperties& properties) {
  Facts facts;
  for (const auto& [name, value] : properties) {
    if (const auto* number = std::get_if<double>(&value)) facts.numbers[name] = *number;
    if (const auto* text = std::get_if<std::string>(&value)) facts.texts[name] = *text;
  }
  return facts;
}

// The first sample's time on the recording's clock, whose 0 is where the first channel that states
// a time says. A time of 0, 1904, is none.
double start_of(const TdmsProperties& properties, Recording& recording) {
  const double offset_s = number_in(properties, "wf_start_offset").value_or(0);
  const double start_s = std::isfinite(offset_s) ? offset_s : 0;
  const double since_1904_s = number_in(properties, "wf_start_time").value_or(0);
  if (since_1904_s == 0) return start_s;
  const double utc_s = since_1904_s - tdms_epoch_before_1970_s;
  if (std::isnan(noted_start_s(recording))) note_start(utc_s, recording);
  const double later_s = utc_s - noted_start_s(recording);
  return std::abs(later_s) > 1e-6 ? start_s + later_s : start_s;
}

// Why the channel is left out, or nothing: then it was added.
std::optional<std::string> add(const TdmsChannel& stored, Recording& recording) {
  if (!is_over_time(stored)) {
    return fmt::format("over {}, not time", text_in(stored.properties, "wf_xunit_string"));
  }
  const auto values = scaled_values(stored);
  if (const auto* fault = std::get_if<std::string>(&values)) return *fault;
  const std::vector<double>& numbers = std::get<0>(values);
  if (numbers.empty()) return std::nullopt;
  Channel channel;
  channel.info.name = stored.name;
  const double increment_s = number_in(stored.properties, "wf_increment").value_or(0);
  channel.rate_Hz = increment_s > 0 && std::isnormal(1 / increment_s) ? 1 / increment_s : 0;
  apply(facts_in(stored.properties), channel);
  channel.start_s = start_of(stored.properties, recording);
  channel.samples =
      Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  channel.samples = channel.samples.array().isFinite().select(channel.samples, not_known);
  apply_unit(unit_text(stored), channel, recording.notes);
  recording.channels.push_back(std::move(channel));
  return std::nullopt;
}

std::uint64_t found_in(const TdmsChannel& channel) {
  std::size_t found = 0;
  for (const auto& [id, values] : channel.raw) found = std::max(found, values.size());
  return found;
}

// A last chunk may be short in a sound file; one that was cut off cannot be trusted.
void describe(const TdmsFile& tdms, const TdmsChannel& channel, Recording& recording) {
  if (!channel.gap.empty() && recording.status == "ok") {
    recording.status = fmt::format("INVALID: {}: {}", channel.name, channel.gap);
  }
  const std::uint64_t found = found_in(channel);
  if (channel.raw.empty() || channel.declared == found) return;
  const std::string counts =
      fmt::format("{}: {} values declared, {} found", channel.name, channel.declared, found);
  if (tdms.is_cut_off) {
    recording.status = "INVALID: " + counts;
  } else {
    recording.notes.push_back(counts);
  }
}

Recording& recording_of(const std::string& group, const TdmsFile& tdms,
                        const std::filesystem::path& file, std::vector<Recording>& recordings) {
  const std::string source = file.string() + "#" + group;
  const auto own = std::ranges::find(recordings, source, &Recording::source);
  if (own != recordings.end()) return *own;
  Recording& recording = recordings.emplace_back();
  recording.source = source;
  recording.status = "ok";
  const auto properties = tdms.groups.find(group);
  if (properties != tdms.groups.end()) apply(facts_in(properties->second), recording);
  return recording;
}

Result<std::vector<Recording>> read_tdms_recordings(const std::filesystem::path& file,
                                                    const TableHints&) {
  const std::string bytes = bytes_of(file);
  const auto parsed = read_tdms(bytes);
  if (const auto* fault = std::get_if<std::string>(&parsed)) return bad_file(file, *fault);
  const auto& tdms = std::get<TdmsFile>(parsed);
  std::vector<Recording> recordings;
  std::string left_out;
  for (const TdmsChannel& channel : tdms.channels) {
    Recording& recording = recording_of(channel.group, tdms, file, recordings);
    describe(tdms, channel, recording);
    if (const auto why = add(channel, recording)) {
      recording.notes.push_back(fmt::format("{} is left out: {}", channel.name, *why));
      left_out += fmt::format("; {}", recording.notes.back());
    }
  }
  std::erase_if(recordings, [](const Recording& r) { return r.channels.empty(); });
  if (recordings.empty()) return bad_file(file, "holds no samples" + left_out);
  for (Recording& recording : recordings) {
    if (tdms.is_unfinished) recording.notes.push_back("unfinished: whoever wrote it was cut off");
    if (tdms.is_cut_off && recording.status == "ok")
      recording.status = "INVALID: the file is cut off";
  }
  if (recordings.size() == 1) recordings[0].source = file.string();
  return recordings;
}

}  // namespace

Format tdms_format() { return {"TDMS", is_tdms, {".tdms"}, read_tdms_recordings}; }

}  // namespace rvbench::hal::formats
