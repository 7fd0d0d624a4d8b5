#include "bench/rig_file.hpp"

#include <cmath>

namespace rvbench::bench {
namespace {

SimRig read_sim(hal::ConfigReader& root, const RigOptions& options) {
  SimRig sim;
  sim.preset = root.text("preset", options.preset);
  sim.seed = options.seed;
  if (root.has("seed")) {
    const double seed = root.number("seed", {0, static_cast<double>(max_seed)});
    if (seed != std::floor(seed)) root.fault("seed", "expected a whole number");
    sim.seed = static_cast<std::uint64_t>(seed);
  }
  sim.watchdog_s = root.number("watchdog_s", {0, 100}, sim.watchdog_s);
  for (hal::ConfigReader& entry : root.objects("faults", false)) {
    sim.faults.push_back(
        {.at_s = entry.number("at_s", {0, 1e6}),
         .device = entry.choice("device", {"inverter"}),
         .fault = entry.choice("fault", {"late", "silent", "garbled", "busy", "dead"})});
  }
  return sim;
}

ReplayRig read_replay(hal::ConfigReader& root) {
  ReplayRig replay;
  replay.recording = root.text("recording");
  replay.rated_output_torque_Nm =
      root.number("rated_output_torque_Nm", {1e-3, 1e6}, replay.rated_output_torque_Nm);
  return replay;
}

}  // namespace

std::variant<RigFile, std::vector<hal::ConfigFault>> read_rig(const std::string& rig,
                                                              const RigOptions& options) {
  if (rig == "sim")
    return RigFile(SimRig{.preset = options.preset, .seed = options.seed, .faults = {}});
  hal::ConfigReader root = hal::ConfigReader::from_file(rig);
  RigFile file = SimRig{};
  if (root.choice("rig", {"sim", "replay"}, "sim") == "replay") {
    file = read_replay(root);
  } else {
    file = read_sim(root, options);
  }
  root.finish();
  if (!root.faults().empty()) return root.faults();
  return file;
}

}  // namespace rvbench::bench
