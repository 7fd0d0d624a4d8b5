#include "hal/formats/tdms_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hal/formats/tdms_chunks.hpp"
#include "hal/formats/tdms_scaling.hpp"

namespace rvbench::hal::formats {
namespace {

using Fault = std::optional<std::string>;

constexpr std::size_t lead_in_bytes = 28;
constexpr std::uint64_t unfinished = 0xFFFFFFFFFFFFFFFF;
constexpr std::size_t nowhere = ~std::size_t{0};  // in the layout

enum Contents : std::uint32_t {
  has_metadata = 1U << 1U,
  has_new_list = 1U << 2U,
  has_raw_data = 1U << 3U,
  is_interleaved = 1U << 5U,
  is_big_endian = 1U << 6U
};

struct LeadIn {
  std::uint32_t contents = 0;
  std::endian order = std::endian::little;
  std::uint64_t length = 0;      // of the segment behind its lead-in
  std::uint64_t raw_offset = 0;  // of raw data, likewise

  bool has(Contents what) const { return (contents & what) != 0; }
};

LeadIn lead_in_of(std::string_view bytes) {
  LeadIn lead;
  lead.contents = number_at<std::uint32_t>(bytes.data() + 4, std::endian::little);
  if (lead.has(is_big_endian)) lead.order = std::endian::big;
  lead.length = number_at<std::uint64_t>(bytes.data() + 12, lead.order);
  lead.raw_offset = number_at<std::uint64_t>(bytes.data() + 20, lead.order);
  return lead;
}

// The names in "/'group'/'channel'", where '' is one '.
std::vector<std::string> names_in(std::string_view path) {
  std::vector<std::string> names;
  bool is_inside = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool quote = path[i] == '\'';
    const bool twice = quote && is_inside && path.substr(i + 1).starts_with('\'');
    if (quote && !twice) {
      is_inside = !is_inside;
      if (is_inside) names.emplace_back();
    } else if (is_inside) {
      names.back() += path[i];
      if (twice) ++i;
    }
  }
  return names;
}

// When a channel's first value was, and the time from one to the next; 0 for what is not stated.
struct WaveformClock {
  double time_s = 0, offset_s = 0, increment_s = 0;
};

bool is_of_clock(std::string_view property) {
  return property == "wf_start_time" || property == "wf_start_offset" || property == "wf_increment";
}

WaveformClock clock_in(const TdmsProperties& properties) {
  const auto stated = [&](const char* name) { return number_in(properties, name).value_or(0); };
  return {stated("wf_start_time"), stated("wf_start_offset"), stated("wf_increment")};
}

// Why values by a later clock are not the next ones behind those before; empty if they are.
std::string break_between(const WaveformClock& first, const WaveformClock& later,
                          std::uint64_t before) {
  constexpr double least_s = 1e-6;  // a double since 1904 tells half of that
  constexpr double one_interval = 1e-6;
  const bool are_known = (first.time_s == 0) == (later.time_s == 0);
  const double since_s = later.time_s - first.time_s + later.offset_s - first.offset_s;
  const double gap_s = since_s - static_cast<double>(before) * first.increment_s;
  if (are_known && since_s != 0 && !(std::abs(gap_s) <= first.increment_s / 2 + least_s)) {
    return fmt::format("{:.6g} s are {} behind its sample {}", std::abs(gap_s),
                       gap_s < 0 ? "there twice" : "missing", before);
  }
  const double change_s = later.increment_s - first.increment_s;
  if (first.increment_s != 0 && !(std::abs(change_s) <= one_interval * first.increment_s)) {
    return fmt::format("from {:.6g} s its sample interval becomes {:.6g} s behind its sample {}",
                       first.increment_s, later.increment_s, before);
  }
  return "";
}

class Reading {
 public:
  // Takes one segment off `bytes`.
  Fault take_segment(std::string_view& bytes) {
    if (bytes.size() < lead_in_bytes) return stop(bytes);
    if (!bytes.starts_with("TDSm")) return "no segment begins here";
    const LeadIn lead = lead_in_of(bytes);
    bytes.remove_prefix(lead_in_bytes);
    file_.is_unfinished = lead.length == unfinished;
    if (!file_.is_unfinished && lead.length > bytes.size()) file_.is_cut_off = true;
    const std::string_view segment = bytes.substr(0, lead.length);
    bytes.remove_prefix(segment.size());
    if (lead.raw_offset > segment.size()) {
      // Its writer had not come to the raw data, or the file was cut off before them.
      if (file_.is_unfinished || file_.is_cut_off) return stop(bytes);
      return "raw data that begin beyond the segment";
    }
    if (lead.has(has_metadata)) {
      if (auto fault = take_metadata(lead, segment.substr(0, lead.raw_offset))) return fault;
    }
    if (!lead.has(has_raw_data)) return std::nullopt;
    return take_values(lead, segment.substr(lead.raw_offset));
  }

  TdmsFile finish() && {
    for (auto& [channel, properties] : restated_) {
      for (auto& [name, value] : properties) file_.channels[channel].properties[name] = value;
    }
    return std::move(file_);
  }

 private:
  Fault stop(std::string_view& bytes) {
    if (!file_.is_unfinished) file_.is_cut_off = true;
    bytes = {};
    return std::nullopt;
  }

  Fault take_metadata(const LeadIn& lead, std::string_view bytes) {
    ByteReader reader(bytes, lead.order);
    auto read = read_tdms_metadata(reader, lead.order);
    if (const auto* fault = std::get_if<std::string>(&read)) return *fault;
    if (lead.has(has_new_list)) {
      std::ranges::fill(place_, nowhere);
      layout_.clear();
    }
    for (TdmsObject& object : std::get<0>(read)) {
      if (auto fault = take_object(object)) return fault;
    }
    close_ranks();
    return std::nullopt;
  }

  // Takes the places that were given up off the layout.
  void close_ranks() {
    if (std::erase_if(layout_, [](const TdmsPlace& p) { return p.channel == nowhere; }) == 0)
      return;
    for (std::size_t i = 0; i < layout_.size(); ++i) place_[layout_[i].channel] = i;
  }

  Fault take_object(TdmsObject& object) {
    const std::vector<std::string> names = names_in(object.path);
    if (names.size() == 1) {
      for (auto& [name, value] : object.properties) file_.groups[names[0]][name] = value;
    }
    if (names.size() != 2) return std::nullopt;  // the file itself, or a group
    const auto [at, is_new] = by_path_.try_emplace(object.path, file_.channels.size());
    const std::size_t channel = at->second;
    if (is_new) {
      file_.channels.push_back({names[0], names[1], {}, {}, false, {}, 0, {}});
      last_index_.emplace_back();
      place_.push_back(nowhere);
    }
    take_properties(object, channel);
    std::size_t& place = place_[channel];
    if (!object.has_data) {
      if (place != nowhere) layout_[place].channel = nowhere;
      place = nowhere;
      return std::nullopt;
    }
    if (object.is_as_before && !last_index_[channel]) {
      return object.path + ": values stored as before, but there are none before";
    }
    if (!object.is_as_before) last_index_[channel] = std::move(object.index);
    if (place == nowhere) {
      place = layout_.size();
      layout_.push_back({channel, *last_index_[channel]});
    } else {
      layout_[place].index = *last_index_[channel];
    }
    return std::nullopt;
  }

  // What is said of the clock behind values is of the values to come, if there are any.
  void take_properties(TdmsObject& object, std::size_t channel) {
    TdmsChannel& own = file_.channels[channel];
    for (auto& [name, value] : object.properties) {
      const bool is_later = own.declared > 0 && is_of_clock(name);
      (is_later ? restated_[channel] : own.properties)[name] = std::move(value);
    }
  }

  // The first clock stays that of the channel.
  void compare_clocks() {
    for (auto& [channel, properties] : restated_) {
      if (place_[channel] == nowhere) continue;
      TdmsChannel& own = file_.channels[channel];
      TdmsProperties later = properties;
      later.insert(own.properties.begin(), own.properties.end());
      own.properties.insert(properties.begin(), properties.end());
      if (!own.gap.empty()) continue;
      own.gap = break_between(clock_in(own.properties), clock_in(later), own.declared);
    }
    std::erase_if(restated_, [this](const auto& said) { return place_[said.first] != nowhere; });
  }

  Fault take_values(const LeadIn& lead, std::string_view bytes) {
    compare_clocks();
    const bool is_cut_off = file_.is_unfinished || file_.is_cut_off;
    return take_tdms_chunks(bytes, {lead.order, lead.has(is_interleaved), is_cut_off}, layout_,
                            file_);
  }

  TdmsFile file_;
  std::map<std::string, std::size_t> by_path_;        // index in file_.channels
  std::vector<std::optional<TdmsIndex>> last_index_;  // of each channel
  std::map<std::size_t, TdmsProperties> restated_;    // of clocks, behind values of each channel
  std::vector<std::size_t> place_;                    // of each channel in layout_
  std::vector<TdmsPlace> layout_;                     // what a chunk holds, in its order
};

}  // namespace

std::variant<TdmsFile, std::string> read_tdms(std::string_view bytes) {
  Reading reading;
  for (int segment = 1; !bytes.empty(); ++segment) {
    if (const Fault fault = reading.take_segment(bytes)) {
      return fmt::format("segment {}: {}", segment, *fault);
    }
  }
  return std::move(reading).finish();
}

}  // namespace rvbench::hal::formats
