#include "hal/formats/read_recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <stdexcept>

#include "hal/formats/choose_format.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/printable.hpp"
#include "hal/formats/shaft_channels.hpp"
#include "hal/formats/strange_file.hpp"

namespace rvbench::hal {
namespace {

using formats::bad_file;
using formats::Format;

constexpr double rate_tolerance = 1e-3;  // crystals agree far better
constexpr double most_slip = 0.05;       // of an asynchronous motor under load

bool differs(double given, double stated, double tolerance) {
  return std::abs(given - stated) > tolerance * stated;
}

// Angle and torque keep a rate that the file states: they have a clock of their own.
void apply_rate(double rate_Hz, Recording& recording) {
  double stated_Hz = 0;
  for (Channel& channel : recording.channels) {
    if (is_of_shaft(channel.info) && channel.rate_Hz > 0) continue;
    if (channel.rate_Hz > 0 && differs(rate_Hz, channel.rate_Hz, rate_tolerance)) {
      stated_Hz = channel.rate_Hz;
    }
    channel.rate_Hz = rate_Hz;
  }
  if (stated_Hz > 0) {
    recording.notes.push_back(
        fmt::format("rate {} Hz as given: the file says {} Hz", rate_Hz, stated_Hz));
  }
}

// What the file says against a speed that was given; empty if one motor may have both.
std::string contradiction(double speed_rpm, const Recording& recording) {
  const double stated_rpm = std::abs(recording.speed_rpm);
  const bool measured = recording.find(channel_names::input_angle) != nullptr;
  if (measured || !(stated_rpm > 0) || !differs(speed_rpm, stated_rpm, most_slip)) return "";
  return fmt::format(
      "says {:.5g} rpm, {} rpm were given: one of them is wrong, and with it every order. "
      "Leave the one out, or write the file anew without the other",
      stated_rpm, speed_rpm);
}

void apply_speed(double speed_rpm, Recording& recording) {
  const double stated_rpm = std::abs(recording.speed_rpm);
  if (stated_rpm > 0 && differs(speed_rpm, stated_rpm, speed_tolerance)) {
    recording.notes.push_back(
        fmt::format("speed {} rpm as given: the file says {:.5g} rpm", speed_rpm, stated_rpm));
  }
  recording.speed_rpm = speed_rpm;
}

void check_hint(const char* name, double value) {
  if (std::isnan(value) || (value > 0 && std::isfinite(value))) return;
  throw std::invalid_argument(fmt::format("read_recordings: {} {} is not above 0", name, value));
}

// An infinity is no measured value: the sample is lost.
void drop_infinities(Recording& recording) {
  Eigen::Index dropped = 0;
  for (Channel& channel : recording.channels) {
    dropped += channel.samples.array().isInf().count();
    channel.samples = channel.samples.array().isFinite().select(channel.samples, not_known);
  }
  if (dropped == 0) return;
  recording.notes.push_back(
      fmt::format("{} infinite, as nothing measured is: taken as lost",
                  dropped == 1 ? "1 sample is" : fmt::format("{} samples are", dropped)));
}

// What a file claims may be more than there is memory for.
Result<std::vector<Recording>> read_within_memory(const Format& format,
                                                  const std::filesystem::path& file,
                                                  const formats::TableHints& hints) {
  constexpr const char* too_much = "holds more samples than there is memory for";
  try {
    return format.read(file, hints);
  } catch (const std::bad_alloc&) {
    return bad_file(file, too_much);
  } catch (const std::length_error&) {
    return bad_file(file, too_much);
  }
}

bool has_samples(const Recording& recording) {
  return std::any_of(recording.channels.begin(), recording.channels.end(),
                     [](const Channel& channel) { return channel.samples.size() > 0; });
}

}  // namespace

Result<std::vector<Recording>> read_recordings(const std::filesystem::path& file,
                                               const RecordingHints& hints) {
  check_hint("rate_Hz", hints.rate_Hz);
  check_hint("speed_rpm", hints.speed_rpm);
  if (const auto obstacle = formats::find_obstacle(file)) return *obstacle;
  if (const auto strange = formats::what_it_looks_like(file)) {
    return bad_file(file, formats::not_read(*strange));
  }
  const std::optional<Format> format = formats::choose_format(file);
  if (!format) return bad_file(file, "no known format (HDF5, MAT, TDMS, WAV, FLAC, UFF, CSV)");
  Result<std::vector<Recording>> read = read_within_memory(*format, file, hints.table);
  if (!read) return IoError{read.error().code, formats::printable(read.error().where)};

  std::vector<Recording> recordings = std::move(read).value();
  std::erase_if(recordings, [](const Recording& recording) { return !has_samples(recording); });
  if (recordings.empty()) return bad_file(file, "holds no samples");
  for (Recording& recording : recordings) {
    drop_infinities(recording);
    formats::use_shaft_channels(recording);
    // Foreign text goes into reports and JSON.
    if (formats::make_printable(recording)) {
      recording.notes.emplace_back(formats::was_not_printable);
    }
    if (!std::isnan(hints.rate_Hz)) apply_rate(hints.rate_Hz, recording);
    if (std::isnan(hints.speed_rpm)) continue;
    const std::string against = contradiction(hints.speed_rpm, recording);
    if (!against.empty()) return bad_file(file, against);
    apply_speed(hints.speed_rpm, recording);
  }
  return recordings;
}

}  // namespace rvbench::hal
