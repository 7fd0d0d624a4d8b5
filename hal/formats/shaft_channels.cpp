#include "hal/formats/shaft_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hal/formats/unwrap_angle.hpp"
#include "hal/types/units.hpp"

namespace rvbench::hal::formats {
namespace {

std::vector<double> known_values(const Channel& channel) {
  std::vector<double> values(channel.samples.begin(), channel.samples.end());
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

// The middle of the values, if nine in ten lie within a tenth of it: a shaft that is measured at a
// steady speed. Else NaN.
double steady_value(std::vector<double> values) {
  constexpr double tenth = 0.1;
  if (values.empty()) return not_known;
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double middle = at(0.5);
  const bool is_steady = at(0.95) - middle <= tenth * std::abs(middle) &&
                         middle - at(0.05) <= tenth * std::abs(middle);
  return is_steady ? middle : not_known;
}

// The shaft turns on, by more than one turn.
bool turns_on(const Channel& channel) {
  const std::vector<double> angle_rad = known_values(channel);
  if (angle_rad.size() < 2) return false;
  const double travel_rad = angle_rad.back() - angle_rad.front();
  if (std::abs(travel_rad) < units::two_pi) return false;
  std::size_t against = 0;
  for (std::size_t i = 1; i < angle_rad.size(); ++i) {
    against += (angle_rad[i] - angle_rad[i - 1]) * travel_rad < 0 ? 1 : 0;
  }
  constexpr std::size_t by_noise = 100;  // one step in so many
  return against * by_noise <= angle_rad.size();
}

void unwrap(Channel& channel, std::vector<std::string>& notes) {
  if (!unwrap_angle(channel.samples)) return;
  notes.push_back(channel.info.name + " starts anew after each turn: the turns were added");
}

void read_speed(Recording& recording) {
  if (std::isfinite(recording.speed_rpm)) return;
  for (const Channel& channel : recording.channels) {
    if (channel.info.unit != "rad/s") continue;
    const std::vector<double> speeds_rad_s = known_values(channel);
    const double speed_rpm = units::rpm_from_rad_s(steady_value(speeds_rad_s));
    if (!(std::abs(speed_rpm) > 0)) continue;
    const auto [least, most] = std::ranges::minmax(speeds_rad_s);
    recording.speed_rpm = speed_rpm;
    recording.notes.push_back(fmt::format("speed {:.5g} rpm from {}, {:.5g} to {:.5g}", speed_rpm,
                                          channel.info.name, units::rpm_from_rad_s(least),
                                          units::rpm_from_rad_s(most)));
    return;
  }
}

}  // namespace

void use_shaft_channels(Recording& recording) {
  for (Channel& channel : recording.channels) {
    const std::string& name = channel.info.name;
    if (name == channel_names::input_angle || name == channel_names::output_angle) {
      unwrap(channel, recording.notes);
    }
  }
  read_speed(recording);
}

bool name_input_angle(Recording& recording) {
  if (recording.find(channel_names::input_angle) != nullptr) return false;
  Channel* only = nullptr;
  for (Channel& channel : recording.channels) {
    if (channel.info.name == channel_names::output_angle || channel.info.unit != "rad") continue;
    unwrap(channel, recording.notes);
    if (!turns_on(channel)) continue;
    if (only != nullptr) {
      recording.notes.push_back(fmt::format("{} and {} both turn on: call one of them {}",
                                            only->info.name, channel.info.name,
                                            channel_names::input_angle));
      return false;
    }
    only = &channel;
  }
  if (only == nullptr) return false;
  recording.notes.push_back(
      fmt::format("{} is taken for the angle of the input shaft", only->info.name));
  only->info.name = channel_names::input_angle;
  return true;
}

}  // namespace rvbench::hal::formats
