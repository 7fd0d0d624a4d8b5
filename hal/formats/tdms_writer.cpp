#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "hal/formats/byte_writer.hpp"
#include "hal/formats/facts.hpp"
#include "hal/formats/start_time.hpp"
#include "hal/formats/tdms_metadata.hpp"
#include "hal/formats/writer.hpp"

// Source  National Instruments, "TPC: The NI TDMS File Format"
namespace rvbench::hal::formats {
namespace {

constexpr std::uint32_t contents = 1U << 1U | 1U << 2U | 1U << 3U;  // metadata, new list, raw data
constexpr std::uint32_t tdms_version = 4713;
constexpr std::uint32_t no_data = 0xFFFFFFFF, index_bytes = 20;

void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

// The properties of one object, counted.
class Properties {
 public:
  void add(const std::string& name, double value) { put(begin(name, TdmsType::float64), value); }
  void add(const std::string& name, std::int32_t value) {
    put(begin(name, TdmsType::int32), value);
  }
  void add(const std::string& name, const std::string& text) {
    put_text(begin(name, TdmsType::text), text);
  }
  // Parts of 2^-64 s, then seconds since 1904.
  void add_time(const std::string& name, double utc_s) {
    const double since_s = utc_s + tdms_epoch_before_1970_s;
    const double whole_s = std::floor(since_s);
    std::string& bytes = begin(name, TdmsType::timestamp);
    put(bytes, static_cast<std::uint64_t>((since_s - whole_s) * 0x1p64));
    put(bytes, static_cast<std::int64_t>(whole_s));
  }
  void add(const Facts& facts) {
    for (const auto& [name, value] : facts.numbers) add(name, value);
    for (const auto& [name, text] : facts.texts) add(name, text);
  }
  void put_into(std::string& bytes) const {
    put(bytes, count_);
    bytes += bytes_;
  }

 private:
  std::string& begin(const std::string& name, TdmsType type) {
    ++count_;
    put_text(bytes_, name);
    put(bytes_, static_cast<std::uint32_t>(type));
    return bytes_;
  }

  std::string bytes_;
  std::uint32_t count_ = 0;
};

// "/'group'/'channel'", where ' is twice what it is.
std::string path_of(std::initializer_list<std::string> names) {
  std::string path;
  for (const std::string& name : names) {
    path += "/'";
    for (const char c : name) path += c == '\'' ? "''" : std::string(1, c);
    path += '\'';
  }
  return path;
}

std::string group_of(const std::vector<Recording>& recordings, std::size_t point) {
  return recordings.size() == 1 ? "recording" : fmt::format("point_{:03}", point);
}

void put_channel(std::string& bytes, const Channel& channel, const std::string& group,
                 double start_utc_s) {
  const bool is_single = are_single(channel.samples);
  put_text(bytes, path_of({group, channel.info.name}));
  put(bytes, index_bytes);
  put(bytes, static_cast<std::uint32_t>(is_single ? TdmsType::float32 : TdmsType::float64));
  put(bytes, std::uint32_t{1});  // dimension
  put(bytes, static_cast<std::uint64_t>(channel.samples.size()));
  Properties properties;
  if (std::isfinite(start_utc_s)) properties.add_time("wf_start_time", start_utc_s);
  properties.add("wf_start_offset", channel.start_s);
  properties.add("wf_increment", 1 / channel.rate_Hz);
  properties.add("wf_samples", static_cast<std::int32_t>(
                                   std::min<Eigen::Index>(channel.samples.size(), INT32_MAX)));
  properties.add("wf_xname", std::string("Time"));
  properties.add("wf_xunit_string", std::string("s"));
  properties.add("unit_string", channel.info.unit);
  Facts facts = facts_of(channel);
  facts.numbers.erase("start_s");  // wf_start_offset
  properties.add(facts);
  properties.put_into(bytes);
}

std::string metadata_of(const std::vector<Recording>& recordings) {
  std::string objects;
  std::uint32_t count = 1;
  put_text(objects, "/");  // the file
  put(objects, no_data);
  put(objects, std::uint32_t{0});
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::string group = group_of(recordings, i);
    put_text(objects, path_of({group}));
    put(objects, no_data);
    Properties properties;
    properties.add(facts_of(recordings[i]));
    properties.put_into(objects);
    for (const Channel& channel : recordings[i].channels) {
      put_channel(objects, channel, group, noted_start_s(recordings[i]));
    }
    count += 1 + static_cast<std::uint32_t>(recordings[i].channels.size());
  }
  std::string bytes;
  put(bytes, count);
  return bytes + objects;
}

std::string raw_of(const Channel& channel) {
  const bool is_single = are_single(channel.samples);
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(channel.samples.size()) * (is_single ? 4 : 8));
  for (const double sample : channel.samples) {
    if (is_single) {
      put(bytes, static_cast<float>(sample));
    } else {
      put(bytes, sample);
    }
  }
  return bytes;
}

std::uint64_t raw_bytes(const std::vector<Recording>& recordings) {
  std::uint64_t bytes = 0;
  for (const Recording& recording : recordings) {
    for (const Channel& channel : recording.channels) {
      bytes += static_cast<std::uint64_t>(channel.samples.size()) *
               (are_single(channel.samples) ? 4U : 8U);
    }
  }
  return bytes;
}

// One segment: lead-in, metadata, and the samples channel by channel.
Status write_tdms(const std::vector<Recording>& recordings, FileDraft& draft) {
  const std::string metadata = metadata_of(recordings);
  std::string lead_in = "TDSm";
  put(lead_in, contents);
  put(lead_in, tdms_version);
  put(lead_in, metadata.size() + raw_bytes(recordings));
  put(lead_in, static_cast<std::uint64_t>(metadata.size()));
  if (Status written = draft.write(lead_in + metadata); !written) return written;
  for (const Recording& recording : recordings) {
    for (const Channel& channel : recording.channels) {
      if (Status written = draft.write(raw_of(channel)); !written) return written;
    }
  }
  return Done{};
}

}  // namespace

Writer tdms_writer() {
  return {"tdms", "TDMS", {".tdms"}, {.recordings = true, .clocks = true}, write_tdms};
}

}  // namespace rvbench::hal::formats
