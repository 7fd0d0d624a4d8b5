#pragma once

#include <memory>

#include "bench/acceptance.hpp"
#include "bench/serve/live_feed.hpp"
#include "hal/rig.hpp"

namespace rvbench::bench {

/// Has the feed see what torque sensor, accelerometers and safety inputs of the rig are read, in
/// every phase. Nothing else of them changes.
void watch(hal::Rig& rig, const std::shared_ptr<LiveFeed>& feed);

/// Has the feed see which points are recorded, and how they end.
RecordingMaker watched_recording(RecordingMaker make, std::shared_ptr<LiveFeed> feed);

}  // namespace rvbench::bench
