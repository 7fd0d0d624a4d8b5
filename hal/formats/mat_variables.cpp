#include "hal/formats/mat_variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "hal/formats/foreign_file.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr Eigen::Index most_channels = 256;  // of one array: more is no set of signals

bool says_rate(std::string_view name) {
  static constexpr std::array<std::string_view, 9> names = {
      "fs", "Fs", "FS", "sr", "SampFreq", "SampleRate", "sample_rate", "sampling_rate", "rate_Hz"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Repeated names get a number.
void add_channel(const std::string& base, Channel channel, std::vector<Channel>& channels) {
  channel.info.name = base;
  const auto taken = [&channel](const Channel& c) { return c.info.name == channel.info.name; };
  for (int n = 2; std::any_of(channels.begin(), channels.end(), taken); ++n) {
    channel.info.name = fmt::format("{}_{}", base, n);
  }
  channels.push_back(std::move(channel));
}

// The longer side of an array is time.
void add_channels(const std::string& name, const Eigen::MatrixXd& values, double rate_Hz,
                  std::vector<Channel>& channels) {
  const bool upright = values.rows() >= values.cols();
  const Eigen::Index count = upright ? values.cols() : values.rows();
  for (Eigen::Index i = 0; i < count; ++i) {
    Channel channel;
    channel.rate_Hz = rate_Hz;
    if (upright) {
      channel.samples = values.col(i);
    } else {
      channel.samples = values.row(i).transpose();
    }
    add_channel(count == 1 ? name : fmt::format("{}_{}", name, i + 1), std::move(channel),
                channels);
  }
}

bool is_record(const MatStructure& structure) {
  return std::ranges::any_of(structure.numbers,
                             [](const auto& field) { return field.second.size() > 1; });
}

}  // namespace

std::optional<std::string> MatVariables::add(const std::string& name, Eigen::MatrixXd values) {
  if (values.size() == 0) return std::nullopt;
  if (values.size() == 1) {
    take(name, name, values(0, 0));
  } else if (std::min(values.rows(), values.cols()) > most_channels) {
    return fmt::format("{}: {} x {} is no set of signals", name, values.rows(), values.cols());
  } else {
    arrays_.push_back({name, std::move(values)});
  }
  return std::nullopt;
}

void MatVariables::add(const MatStructure& structure) {
  if (take_recording(structure, all_)) return;
  if (auto channel = channel_in(structure)) {
    const std::string name = channel->info.name;
    return add_channel(name, *std::move(channel), channels_);
  }
  structures_.push_back(structure);
}

void MatVariables::take(const std::string& name, const std::string& shown_as, double value) {
  const bool is_rate = says_rate(name);
  const bool is_speed = name.ends_with("RPM") || name.ends_with("rpm");
  if (!(value > 0) || !std::isfinite(value)) {
    if (!is_rate && !is_speed) return;
    note(fmt::format("{}: {} is no {} and is not taken", shown_as, value,
                     is_rate ? "rate" : "speed of a shaft that turns forward"));
    return;
  }
  if (is_rate) set(rate_Hz_, 0, value, "rate_Hz from " + shown_as);
  if (is_speed) {
    speeds_rpm_.emplace(name.substr(0, name.size() - 3), value);
    set(speed_rpm_, not_known, value, "speed_rpm from " + shown_as);
  }
}

// What the file says twice, and differently, it does not say.
void MatVariables::set(std::optional<double>& said, double unsaid, double value,
                       const std::string& what) {
  if (said == value) return;
  note(said ? fmt::format("{}: {}, but {} elsewhere: neither is taken", what, value, *said)
            : fmt::format("{}: {}", what, value));
  said = said ? unsaid : value;
}

// Of arrays of one name, those of zeros only are left out if another one is not: some loggers
// write a variable once to reserve room, and again with what they measured.
void MatVariables::drop_placeholders() {
  const auto is_placeholder = [this](const NamedArray& array) {
    return array.values.isZero(0) &&
           std::any_of(arrays_.begin(), arrays_.end(), [&array](const NamedArray& other) {
             return other.name == array.name && !other.values.isZero(0);
           });
  };
  std::vector<NamedArray> kept;
  for (const NamedArray& array : arrays_) {
    if (is_placeholder(array)) {
      note(fmt::format("{} is there more than once: one of zeros only is left out", array.name));
    } else {
      kept.push_back(array);
    }
  }
  arrays_ = std::move(kept);
}

void MatVariables::note_left_out(std::vector<std::string>& notes) const {
  if (left_out_.empty()) return;
  constexpr std::size_t most = 12;
  const auto some = std::span(left_out_).first(std::min(most, left_out_.size()));
  const std::string more =
      left_out_.size() > most ? fmt::format(" and {} more", left_out_.size() - most) : "";
  notes.push_back(fmt::format("left out: {}{}", fmt::join(some, ", "), more));
}

// The longest arrays of each structure are its signals.
std::vector<Recording> MatVariables::records_in_structures(const std::filesystem::path& file) {
  const bool is_only = std::ranges::count_if(structures_, is_record) == 1;
  std::vector<Recording> records;
  for (const MatStructure& structure : structures_) {
    if (!is_record(structure)) continue;
    MatVariables own;
    Eigen::Index longest = 0;
    for (const auto& [field, values] : structure.numbers) {
      longest = std::max(longest, std::max(values.rows(), values.cols()));
    }
    for (const auto& [field, values] : structure.numbers) {
      const std::string name = structure.name + "." + field;
      if (values.size() == 1) {
        own.take(field, name, values(0, 0));
      } else if (values.size() > 1 && std::max(values.rows(), values.cols()) == longest) {
        if (const auto fault = own.add(name, values)) own.note(*fault);
        own.note("the record is " + name);
      } else if (values.size() > 1) {
        own.leave_out(name + " (shorter than the record)");
      }
    }
    records.push_back(std::move(own).record(file.string() + (is_only ? "" : "#" + structure.name)));
  }
  return records;
}

// Each speed has the arrays whose names begin as its own does; nothing where one has none.
std::vector<Recording> MatVariables::records_by_speed(const std::filesystem::path& file) {
  std::map<std::string, MatVariables> of_speed;
  for (const NamedArray& array : arrays_) {
    const auto own = std::ranges::find_if(speeds_rpm_, [&](const auto& speed) {
      return !speed.first.empty() && array.name.starts_with(speed.first);
    });
    if (own == speeds_rpm_.end()) return {};
    of_speed[own->first].arrays_.push_back(array);
  }
  if (of_speed.size() < 2) return {};
  std::vector<Recording> records;
  for (auto& [prefix, own] : of_speed) {
    own.rate_Hz_ = rate_Hz_;
    own.speed_rpm_ = speeds_rpm_.at(prefix);
    own.note(fmt::format("speed_rpm from {}RPM: {}", prefix, speeds_rpm_.at(prefix)));
    own.left_out_ = left_out_;
    own.drop_placeholders();
    records.push_back(std::move(own).record(file.string() + "#" + prefix));
  }
  return records;
}

Recording MatVariables::record(const std::string& source) && {
  Recording recording = std::move(all_);
  recording.source = source;
  if (recording.status.empty()) recording.status = "ok";
  if (speed_rpm_) recording.speed_rpm = *speed_rpm_;
  recording.notes.insert(recording.notes.end(), notes_.begin(), notes_.end());
  note_left_out(recording.notes);
  recording.channels = std::move(channels_);
  for (const NamedArray& array : arrays_) {
    add_channels(array.name, array.values, rate_Hz_.value_or(0), recording.channels);
  }
  return recording;
}

Result<std::vector<Recording>> MatVariables::finish(const std::filesystem::path& file) && {
  if (arrays_.empty() && channels_.empty()) {
    std::vector<Recording> records = records_in_structures(file);
    for (Recording& each : records) {
      each.notes.insert(each.notes.end(), notes_.begin(), notes_.end());
      note_left_out(each.notes);
    }
    if (!records.empty()) return records;
  }
  for (const MatStructure& structure : structures_) {
    for (const auto& [field, values] : structure.numbers) {
      const std::string name = structure.name + "." + field;
      if (values.size() == 1) take(field, name, values(0, 0));
      if (values.size() > 1) leave_out(name + " (in a structure)");
    }
  }
  if (arrays_.empty() && channels_.empty()) {
    note_left_out(notes_);
    if (!notes_.empty()) {
      return bad_file(file, fmt::format("holds no samples; {}", fmt::join(notes_, "; ")));
    }
  }
  if (speeds_rpm_.size() > 1 && channels_.empty()) {
    if (auto records = records_by_speed(file); !records.empty()) return records;
  }
  drop_placeholders();
  return alone(std::move(*this).record(file.string()));
}

}  // namespace rvbench::hal::formats
