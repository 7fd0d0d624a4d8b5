#include "bench/rig_factory.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/file_kind.hpp"
#include "bench/rig_file.hpp"
#include "hal/replay_rig.hpp"
#include "hal/simulated_rig.hpp"
#include "sim/bench_world.hpp"
#include "sim/plant_json.hpp"
#include "sim/preset_files.hpp"

namespace rvbench::bench {
namespace {

using Made = std::variant<hal::Rig, std::vector<hal::ConfigFault>>;

sim::WireFault wire_fault(const std::string& name) {
  static const std::map<std::string, sim::WireFault> faults{
      {"none", sim::WireFault::none},     {"late", sim::WireFault::late},
      {"silent", sim::WireFault::silent}, {"garbled", sim::WireFault::garbled},
      {"busy", sim::WireFault::busy},     {"dead", sim::WireFault::dead}};
  return faults.at(name);
}

// The inverter knows one fault at a time: each waits until it is due, then replaces the one
// before.
void schedule(sim::BenchWorld& world, const ScheduledFault& fault) {
  world.at(fault.at_s, [&server = world.inverter_server(), kind = wire_fault(fault.fault)] {
    server.inject({.fault = kind});
  });
}

// Faults of a plant, at the key of the rig file that names it.
std::vector<hal::ConfigFault> at_plant(const std::string& plant,
                                       const std::vector<hal::ConfigFault>& own) {
  std::vector<hal::ConfigFault> faults;
  for (const hal::ConfigFault& fault : own) {
    faults.push_back({0, "/plant", hal::describe(plant, fault)});
  }
  return faults;
}

// The plant that a simulated bench turns, or its faults.
std::variant<sim::PlantSpec, std::vector<hal::ConfigFault>> runnable_plant(const SimRig& rig) {
  auto read = sim::read_plant(rig.plant);
  if (read.index() == 1) return at_plant(rig.plant, std::get<1>(read));
  const auto faults = sim::rv_plant_faults(std::get<0>(read));
  if (!faults.empty()) return at_plant(rig.plant, faults);
  return std::get<0>(std::move(read));
}

Made make(const SimRig& rig) {
  const auto plant = runnable_plant(rig);
  if (plant.index() == 1) return std::get<1>(plant);
  try {
    auto world = std::make_unique<sim::BenchWorld>(
        rig.preset, rig.seed, sim::InverterParameters{.comm_loss_timeout_s = rig.watchdog_s},
        std::get<0>(plant));
    for (const ScheduledFault& fault : rig.faults) schedule(*world, fault);
    const hal::SimulatedRigOptions options{.torque_rate_Hz = world->transducer().rate_Hz()};
    return hal::make_simulated_rig(std::move(world), options);
  } catch (const std::invalid_argument& error) {
    return std::vector<hal::ConfigFault>{{0, "/preset", error.what()}};
  }
}

Made make(const ReplayRig& rig) {
  if (const auto twin = sim::read_plant(rig.plant); twin.index() == 1) {
    return at_plant(rig.plant, std::get<1>(twin));
  }
  Result<hal::Rig> made = hal::make_replay_rig(
      rig.recording,
      {.rated_output_torque_Nm = rig.rated_output_torque_Nm, .real_time = rig.pace == "real_time"});
  if (!made) return std::vector<hal::ConfigFault>{{0, "/recording", describe(made.error())}};
  return std::move(made).value();
}

// A run needs more than a drive; what there is no backend for yet is told rather than left out.
Made make(const BenchRig& rig) {
  if (const auto twin = sim::read_plant(rig.plant); twin.index() == 1) {
    return at_plant(rig.plant, std::get<1>(twin));
  }
  return std::vector<hal::ConfigFault>{
      {0, "/rig",
       "a run needs accelerometers, a torque transducer and a brake besides the drive; this "
       "version knows them in simulation only. rvbench probe works with this file"}};
}

nlohmann::ordered_json to_json(const BenchRig& rig) {
  return {{"rig", "bench"}, {"drive", to_json(rig.drive)}, {"plant", rig.plant}};
}

nlohmann::ordered_json to_json(const SimRig& rig) {
  auto faults = nlohmann::ordered_json::array();
  for (const ScheduledFault& fault : rig.faults) {
    faults.push_back({{"at_s", fault.at_s}, {"device", fault.device}, {"fault", fault.fault}});
  }
  return {{"rig", "sim"},       {"preset", rig.preset},         {"seed", rig.seed},
          {"plant", rig.plant}, {"watchdog_s", rig.watchdog_s}, {"faults", faults}};
}

nlohmann::ordered_json to_json(const ReplayRig& rig) {
  return {{"rig", "replay"},
          {"recording", rig.recording},
          {"pace", rig.pace},
          {"rated_output_torque_Nm", rig.rated_output_torque_Nm},
          {"plant", rig.plant}};
}

}  // namespace

std::vector<std::string> preset_names() { return names_of(sim::preset_files()); }

Made make_rig(const std::string& rig, const RigOptions& options) {
  auto file = read_rig(rig, options);
  if (file.index() == 1) return std::get<1>(std::move(file));
  return std::visit([](const auto& kind) { return make(kind); }, std::get<0>(file));
}

std::vector<hal::ConfigFault> check_rig(const std::string& file) {
  auto rig = read_rig(file, {});
  if (rig.index() == 1) return std::get<1>(std::move(rig));
  if (const auto* simulated = std::get_if<SimRig>(&std::get<0>(rig))) {
    auto plant = runnable_plant(*simulated);
    return plant.index() == 1 ? std::get<1>(std::move(plant)) : std::vector<hal::ConfigFault>{};
  }
  if (const auto* bench = std::get_if<BenchRig>(&std::get<0>(rig))) {
    const auto twin = sim::read_plant(bench->plant);
    return twin.index() == 1 ? at_plant(bench->plant, std::get<1>(twin))
                             : std::vector<hal::ConfigFault>{};
  }
  Made made = make(std::get<ReplayRig>(std::get<0>(rig)));  // its recording may be missing, or none
  return made.index() == 1 ? std::get<1>(std::move(made)) : std::vector<hal::ConfigFault>{};
}

std::string rig_to_json(const std::string& rig, const RigOptions& options) {
  const auto file = read_rig(rig, options);
  if (file.index() == 1) throw std::invalid_argument("rig_to_json: " + rig + " has faults");
  return std::visit([](const auto& kind) { return to_json(kind); }, std::get<0>(file)).dump(2) +
         "\n";
}

}  // namespace rvbench::bench
