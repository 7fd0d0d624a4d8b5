#include "bench/channel_fault.hpp"

#include <fmt/format.h>

#include "analysis/quality.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {

std::string channel_fault(const Recording& recording, const sim::OutputSpec& output) {
  const std::string name = hal::in_quotes(output.channel);
  const Channel* channel = recording.find(output.channel);
  if (channel == nullptr) return name + " is no channel of the recording";
  if (!channel->info.unit.empty() && channel->info.unit != output.unit) {
    return fmt::format("{} is in {}, the plant shows {}", name, channel->info.unit, output.unit);
  }
  if (!channel->samples.allFinite()) return name + " has samples that are not finite";
  for (const analysis::QualityNote& note : analysis::channel_quality(*channel, not_known)) {
    if (note.invalidates) return name + " is " + note.what;
  }
  return {};
}

}  // namespace rvbench::bench
