#include "bench/recordings_to_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/quality.hpp"
#include "analysis/shaft_angle.hpp"
#include "bench/command.hpp"
#include "bench/no_accelerations.hpp"
#include "bench/stop_on_signal.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/formats/shaft_channels.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

constexpr double least_peak = 1e-30;
constexpr double largest_peak = 1e30;

// No vibration in any unit: squares of it would overflow, or vanish.
std::optional<std::string> what_is_beyond(const Recording& record, const std::string& file,
                                          const std::string& kept) {
  for (const Channel* channel : analysis::acceleration_channels(record)) {
    if (!kept.empty() && channel->info.name != kept) continue;
    double most = 0;
    for (const double x : channel->samples) {
      if (std::isfinite(x)) most = std::max(most, std::abs(x));
    }
    if (most == 0 || (most >= least_peak && most <= largest_peak)) continue;
    return fmt::format("{}: {}: its largest sample, {:.3g}, is no vibration in any unit", file,
                       channel->info.name, most);
  }
  return std::nullopt;
}

std::optional<std::string> what_cannot_be_judged(Recording& record, const std::string& file,
                                                 const std::string& kept) {
  if (const auto beyond = what_is_beyond(record, file, kept)) return beyond;
  const auto uneven = leave_out_what_is_no_acceleration(kept, record);
  if (uneven) return file + ": " + *uneven;
  return std::nullopt;
}

std::optional<std::string> what_is_not_stated(const Recording& record, const std::string& file,
                                              const std::string& hint) {
  for (const Channel& channel : record.channels) {
    if (!(channel.rate_Hz > 0)) {
      return file + " states no sample rate: give it with --rate HZ" + hint;
    }
  }
  const bool has_speed =
      std::isfinite(record.speed_rpm) || record.find(channel_names::input_angle) != nullptr;
  if (!has_speed) return file + " states no shaft speed: give it with --speed RPM" + hint;
  return std::nullopt;
}

void prefer_speed(double speed_rpm, Recording& record) {
  const auto angle = analysis::ShaftAngle::of(record);
  if (!angle || !angle->is_measured()) return;
  const double measured_rpm = units::rpm_from_Hz(angle->mean_speed_Hz());
  if (std::abs(speed_rpm - measured_rpm) <= hal::speed_tolerance * measured_rpm) return;
  record.notes.push_back(fmt::format(
      "speed {} rpm as given: the shaft's angle, which says {:.5g} rpm and so differs by "
      "{:.1f} %, is left out",
      speed_rpm, measured_rpm, 100 * std::abs(speed_rpm / measured_rpm - 1)));
  std::erase_if(record.channels, [](const Channel& channel) {
    return channel.info.name == channel_names::input_angle;
  });
}

// Nothing if at least the input shaft's own order is below half the rate.
std::optional<std::string> what_is_too_slow(const Recording& record, const std::string& file) {
  const auto angle = analysis::ShaftAngle::of(record);
  if (!angle) return std::nullopt;
  const double shaft_Hz = angle->mean_speed_Hz();
  for (const Channel* channel : analysis::acceleration_channels(record)) {
    if (shaft_Hz < channel->rate_Hz / 2) continue;
    return fmt::format(
        "{}: the input shaft turns {:.4g} times a second, and {:.4g} samples a second show only "
        "what is below {:.4g} Hz: is --rate in Hz, and --speed in rpm?",
        file, shaft_Hz, channel->rate_Hz, channel->rate_Hz / 2);
  }
  return std::nullopt;
}

// Leaves the channel asked for, beside angle and torque. @return whether it is there
bool keep_channel(const std::string& name, Recording& record) {
  if (name.empty()) return true;
  if (record.find(name) == nullptr) return false;
  std::erase_if(record.channels, [&](const Channel& channel) {
    return channel.info.name != name && !is_of_shaft(channel.info);
  });
  return true;
}

void add_names(const Recording& record, std::vector<std::string>& names) {
  for (const Channel* channel : analysis::acceleration_channels(record)) {
    const std::string& name = channel->info.name;
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
}

}  // namespace

std::variant<std::vector<Recording>, JudgeRefusal> recordings_to_judge(const JudgeInput& input) {
  std::vector<Recording> records;
  std::vector<std::string> channels;
  for (const std::string& file : input.files) {
    end_if_stopped(input.stop);
    Result<std::vector<Recording>> read = hal::read_recordings(file, input.hints);
    if (!read) return JudgeRefusal{exit_codes::data_refused, read.error().where};
    for (Recording& record : std::move(read).value()) {
      hal::formats::name_input_angle(record);
      if (const auto spoiled = what_cannot_be_judged(record, file, input.channel)) {
        return JudgeRefusal{exit_codes::data_refused, *spoiled};
      }
      const std::string hint =
          record.notes.empty() ? "" : fmt::format(" ({})", fmt::join(record.notes, "; "));
      if (const auto unstated = what_is_not_stated(record, file, hint)) {
        return JudgeRefusal{exit_codes::usage, *unstated};
      }
      if (std::isfinite(input.hints.speed_rpm)) prefer_speed(input.hints.speed_rpm, record);
      if (const auto slow = what_is_too_slow(record, file)) {
        return JudgeRefusal{exit_codes::usage, *slow};
      }
      add_names(record, channels);
      if (keep_channel(input.channel, record)) records.push_back(std::move(record));
    }
  }
  if (!records.empty()) return records;
  return JudgeRefusal{exit_codes::usage, "no recording has a channel \"" + input.channel + "\"" +
                                             hal::what_there_is(input.channel, channels)};
}

}  // namespace rvbench::bench
