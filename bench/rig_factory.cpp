#include "bench/rig_factory.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/file_kind.hpp"
#include "bench/rig_file.hpp"
#include "bench/sim_world.hpp"
#include "hal/replay_rig.hpp"
#include "hal/simulated_rig.hpp"
#include "sim/bench_world.hpp"
#include "sim/plant_json.hpp"
#include "sim/preset_files.hpp"

namespace rvbench::bench {
namespace {

using Made = std::variant<hal::Rig, std::vector<hal::ConfigFault>>;

// The inverter knows one fault at a time: each waits until it is due, then replaces the one
// before.
void schedule(sim::BenchWorld& world, const ScheduledFault& fault) {
  world.at(fault.at_s, [&server = world.inverter_server(), kind = wire_fault(fault.fault)] {
    server.inject({.fault = kind});
  });
}

Made make(const SimRig& rig) {
  auto made = make_world(rig);
  if (made.index() == 1) return std::get<1>(std::move(made));
  auto world = std::get<0>(std::move(made));
  for (const ScheduledFault& fault : rig.faults) schedule(*world, fault);
  const hal::SimulatedRigOptions options{.torque_rate_Hz = world->transducer().rate_Hz()};
  return hal::make_simulated_rig(std::move(world), options);
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

Made make(const BenchRig& rig) {
  if (const auto twin = sim::read_plant(rig.plant); twin.index() == 1) {
    return at_plant(rig.plant, std::get<1>(twin));
  }
  return make_bench(rig);
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
