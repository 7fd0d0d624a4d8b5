#include "bench/no_accelerations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "analysis/quality.hpp"
#include "bench/rising_channels.hpp"

namespace rvbench::bench {
namespace {

// A velocity or a force is judged as no acceleration, and nobody should think that it was.
void note_other_units(const std::string& kept, Recording& record) {
  const std::vector<const Channel*> judged = analysis::acceleration_channels(record);
  for (const Channel& channel : record.channels) {
    if (channel.info.name == kept || is_of_shaft(channel.info) ||
        std::ranges::find(judged, &channel) != judged.end())
      continue;
    record.notes.push_back(fmt::format(
        "{} is in {}, no acceleration{}, and is left out", channel.info.name, channel.info.unit,
        channel.info.unit == "V" ? " as long as nobody says how many volts are one" : ""));
  }
}

}  // namespace

std::optional<std::string> leave_out_what_is_no_acceleration(const std::string& kept,
                                                             Recording& record) {
  note_other_units(kept, record);
  return leave_out_rising_channels(kept, record);
}

}  // namespace rvbench::bench
