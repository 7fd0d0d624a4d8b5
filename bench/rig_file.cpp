#include "bench/rig_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/file_kind.hpp"
#include "bench/sim_world.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

// Nothing if there is such a preset.
std::string preset_fault(const std::string& preset) {
  const std::vector<std::string> names = preset_names();
  if (std::ranges::find(names, preset) != names.end()) return "";
  return "no preset " + hal::in_quotes(preset) + hal::what_there_is(preset, names);
}

constexpr hal::Bounds severities{0, 100};

std::string severity_fault(std::optional<double> severity) {
  if (!severity || (*severity >= severities.min && *severity <= severities.max)) return "";
  return fmt::format("severity {} is outside {} to {}", *severity, severities.min, severities.max);
}

SimRig read_sim(hal::ConfigReader& root, const RigOptions& options) {
  SimRig sim;
  sim.preset = root.text("preset", options.preset);
  if (const auto fault = preset_fault(sim.preset); !fault.empty()) root.fault("preset", fault);
  sim.seed = options.seed;
  if (root.has("seed")) {
    const double seed = root.number("seed", {0, static_cast<double>(max_seed)});
    if (seed != std::floor(seed)) root.fault("seed", "expected a whole number");
    sim.seed = static_cast<std::uint64_t>(seed);
  }
  sim.severity = options.severity;
  if (root.has("severity")) sim.severity = root.number("severity", severities);
  sim.plant = root.text("plant", sim.plant);
  sim.watchdog_s = root.number("watchdog_s", {0, 100}, sim.watchdog_s);
  sim.holding_brake = root.boolean("holding_brake", sim.holding_brake);
  for (hal::ConfigReader& entry : root.objects("faults", false)) {
    sim.faults.push_back(
        {.at_s = entry.number("at_s", {0, 1e6}),
         .device = entry.choice("device", {"inverter"}),
         .fault = entry.choice("fault", {"none", "late", "silent", "garbled", "busy", "dead"})});
  }
  sim.qualification = read_qualification_section(root, "sim", channels_of(sim));
  return sim;
}

ReplayRig read_replay(hal::ConfigReader& root) {
  ReplayRig replay;
  replay.recording = root.text("recording");
  replay.pace = root.choice("pace", {"virtual", "real_time"}, replay.pace);
  replay.rated_output_torque_Nm =
      root.number("rated_output_torque_Nm", {1e-3, 1e6}, replay.rated_output_torque_Nm);
  replay.plant = root.text("plant", replay.plant);
  return replay;
}

}  // namespace

std::string plant_of(const RigFile& rig) {
  return std::visit([](const auto& kind) { return kind.plant; }, rig);
}

const QualificationSection* qualification_in(const RigFile& rig) {
  const auto in = [](const std::optional<QualificationSection>& section) {
    return section ? &*section : nullptr;
  };
  if (const auto* sim = std::get_if<SimRig>(&rig)) return in(sim->qualification);
  if (const auto* bench = std::get_if<BenchRig>(&rig)) return in(bench->qualification);
  return nullptr;  // a recording is judged as it is
}

std::vector<ChannelInfo> channels_of(const RigFile& rig) {
  if (const auto* sim = std::get_if<SimRig>(&rig)) return channels_of(*sim);
  if (const auto* bench = std::get_if<BenchRig>(&rig)) return channels_of(*bench);
  return {};
}

std::variant<RigFile, std::vector<hal::ConfigFault>> read_rig(const std::string& rig,
                                                              const RigOptions& options) {
  using Faults = std::vector<hal::ConfigFault>;
  if (rig == "sim") {
    Faults faults;
    if (const auto fault = preset_fault(options.preset); !fault.empty()) {
      faults.push_back({0, "/preset", fault});
    }
    if (const auto fault = severity_fault(options.severity); !fault.empty()) {
      faults.push_back({0, "/severity", fault});
    }
    if (!faults.empty()) return faults;
    return RigFile(SimRig{.preset = options.preset,
                          .seed = options.seed,
                          .severity = options.severity,
                          .faults = {}});
  }
  if (is_absent(rig)) {
    return Faults{
        {0, "", "cannot be read: No such file or built-in rig" + hal::what_there_is(rig, {"sim"})}};
  }
  hal::ConfigReader root = hal::ConfigReader::from_file(rig);
  if (auto fault = other_kind_fault(root, "rig")) return Faults{*fault};
  RigFile file = SimRig{};
  const std::size_t faults_before = root.faults().size();
  const std::string kind = root.choice("rig", {"sim", "replay", "bench"}, "sim");
  if (root.faults().size() > faults_before)
    return root.faults();  // whose keys these are, nobody knows
  if (kind == "sim") file = read_sim(root, options);
  if (kind == "replay") file = read_replay(root);
  if (kind == "bench") file = read_bench_rig(root);
  root.finish();
  if (!root.faults().empty()) return root.faults();
  return file;
}

}  // namespace rvbench::bench
