#include "analysis/compare/record_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/compare/block_spectrum.hpp"
#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

// Why nothing of the record can be compared; empty if something can.
std::string unfit(const Recording& record, const std::optional<ShaftAngle>& angle) {
  if (!record.status.empty() && record.status != "ok") return "its status is " + record.status;
  if (!angle) return "neither angle nor speed of the input shaft is known";
  if (acceleration_channels(record).empty()) return "it has no acceleration";
  return "";
}

void tell_short(const ShaftAngle& angle, const Kinematics& kinematics, const Channel& x,
                RecordLevels& levels) {
  const double length_s = double(x.samples.size()) / x.rate_Hz;
  const double turns = angle.mean_speed_Hz() * length_s;
  const int needed = block_turns(kinematics);
  if (turns >= needed) return;
  levels.too_short = {length_s, needed / angle.mean_speed_Hz(), levels.measured_rpm};
  levels.left_out.push_back(
      {levels.source,
       fmt::format("spans {:.0f} turns of the input shaft, and {} part its lines: {:.3g} s are too "
                   "short, {:.3g} s are needed, only its levels are compared",
                   turns, needed, length_s, levels.too_short->needed_s)});
}

// Of two channels that have one name nobody knows which is held against which.
bool is_one_of_two(const Channel* channel, const std::vector<const Channel*>& all) {
  return std::ranges::count_if(
             all, [&](const Channel* other) { return other->info.name == channel->info.name; }) > 1;
}

void tell_no_acceleration(const Recording& record, const std::vector<const Channel*>& accelerations,
                          RecordLevels& levels) {
  for (const Channel& channel : record.channels) {
    if (is_of_shaft(channel.info)) continue;
    if (std::ranges::find(accelerations, &channel) != accelerations.end()) continue;
    levels.left_out.push_back({record.source + ", " + channel.info.name,
                               "is in " + channel.info.unit + ", no acceleration"});
  }
}

}  // namespace

RecordLevels measure_levels(const Recording& record, const Kinematics& kinematics,
                            const std::vector<Quantity>& quantities) {
  RecordLevels levels{
      record.source, record.planned_speed_rpm, record.speed_rpm, record.load_pct, {}, {}, {}};
  const std::optional<ShaftAngle> angle = ShaftAngle::of(record);
  if (angle) levels.measured_rpm = units::rpm_from_Hz(angle->mean_speed_Hz());
  for (const double known_rpm : {record.speed_rpm, levels.measured_rpm}) {
    if (!std::isfinite(levels.speed_rpm)) levels.speed_rpm = known_rpm;
  }
  if (const std::string why = unfit(record, angle); !why.empty()) {
    levels.left_out.push_back({record.source, why});
    return levels;
  }
  const std::vector<const Channel*> channels = acceleration_channels(record);
  tell_no_acceleration(record, channels, levels);
  const auto notes = record_quality(channels, *angle, kinematics, not_known);
  std::vector<const Channel*> trusted;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (is_one_of_two(channels[i], channels)) {
      levels.left_out.push_back({record.source + ", " + channels[i]->info.name,
                                 "another channel of the record has the same name"});
      continue;
    }
    const auto spoilt = std::ranges::find_if(notes[i], &QualityNote::invalidates);
    if (spoilt == notes[i].end()) {
      trusted.push_back(channels[i]);
    } else {
      levels.left_out.push_back({record.source + ", " + spoilt->where, spoilt->what});
    }
  }
  if (!trusted.empty()) tell_short(*angle, kinematics, *trusted.front(), levels);
  levels.channels.resize(trusted.size());
  parallel_for(trusted.size(), [&](std::size_t i) {
    levels.channels[i] = measure_channel(*trusted[i], *angle, kinematics, quantities);
  });
  return levels;
}

}  // namespace rvbench::analysis
