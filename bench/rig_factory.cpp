#include "bench/rig_factory.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/fault_lines.hpp"
#include "bench/file_kind.hpp"
#include "bench/json_text.hpp"
#include "bench/rig_file.hpp"
#include "bench/sim_world.hpp"
#include "hal/json_object.hpp"
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
  sim::BenchWorld* const bench = world.get();
  hal::Rig made_rig = hal::make_simulated_rig(std::move(world), options);
  made_rig.tap_housing = [bench] { bench->tap_housing(); };
  return made_rig;
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
  Made made = make_bench(rig);
  const auto twin = sim::read_plant(rig.plant);
  if (twin.index() == 0) return made;
  auto faults = at_plant(rig.plant, std::get<1>(twin));
  if (made.index() == 1) std::ranges::move(std::get<1>(made), std::back_inserter(faults));
  return faults;
}

std::vector<hal::ConfigFault> check(const SimRig& rig) {
  auto plant = runnable_plant(rig);
  return plant.index() == 1 ? std::get<1>(std::move(plant)) : std::vector<hal::ConfigFault>{};
}

std::vector<hal::ConfigFault> check(const ReplayRig& rig) {
  Made made = make(rig);  // its recording may be missing, or none
  return made.index() == 1 ? std::get<1>(std::move(made)) : std::vector<hal::ConfigFault>{};
}

std::vector<hal::ConfigFault> check(const BenchRig& rig) {
  const auto twin = sim::read_plant(rig.plant);
  return twin.index() == 1 ? at_plant(rig.plant, std::get<1>(twin))
                           : std::vector<hal::ConfigFault>{};
}

nlohmann::ordered_json to_json(const SimRig& rig) {
  auto faults = nlohmann::ordered_json::array();
  for (const ScheduledFault& fault : rig.faults) {
    faults.push_back(
        hal::json_object({{"at_s", fault.at_s}, {"device", fault.device}, {"fault", fault.fault}}));
  }
  nlohmann::ordered_json json =
      hal::json_object({{"rig", "sim"}, {"preset", rig.preset}, {"seed", rig.seed}});
  if (rig.severity) json["severity"] = *rig.severity;
  json["plant"] = rig.plant;
  json["watchdog_s"] = rig.watchdog_s;
  json["holding_brake"] = rig.holding_brake;
  json["faults"] = faults;
  if (rig.qualification) json["qualification"] = to_json(*rig.qualification);
  return json;
}

nlohmann::ordered_json to_json(const ReplayRig& rig) {
  return hal::json_object({{"rig", "replay"},
                           {"recording", rig.recording},
                           {"pace", rig.pace},
                           {"rated_output_torque_Nm", rig.rated_output_torque_Nm},
                           {"plant", rig.plant}});
}

}  // namespace

std::vector<std::string> preset_names() { return names_of(sim::preset_files()); }

Made make_rig(const RigFile& file, const std::string& rig) {
  Made made = std::visit([](const auto& kind) { return make(kind); }, file);
  if (made.index() == 1) return with_lines(rig, std::get<1>(std::move(made)));
  return made;
}

Made make_rig(const std::string& rig, const RigOptions& options) {
  auto file = read_rig(rig, options);
  if (file.index() == 1) return std::get<1>(std::move(file));
  return make_rig(std::get<0>(file), rig);
}

std::vector<hal::ConfigFault> check_rig(const std::string& file) {
  const auto rig = read_rig(file, {});
  if (rig.index() == 1) return std::get<1>(rig);
  return with_lines(file,
                    std::visit([](const auto& kind) { return check(kind); }, std::get<0>(rig)));
}

RigRemarks remarks_on(const RigFile& file, const std::string& rig) {
  const auto* bench = std::get_if<BenchRig>(&file);
  if (bench == nullptr) return {};
  RigRemarks remarks{with_lines(rig, unfit_for_runs(*bench)), {}};
  if (bench->safety) remarks.warnings = with_lines(rig, warnings_of(*bench->safety));
  return remarks;
}

RigRemarks remarks_on(const std::string& file) {
  const auto rig = read_rig(file, {});
  return rig.index() == 0 ? remarks_on(std::get<0>(rig), file) : RigRemarks{};
}

std::string rig_to_json(const RigFile& file) {
  return json_text(std::visit([](const auto& kind) { return to_json(kind); }, file));
}

std::string rig_to_json(const std::string& rig, const RigOptions& options) {
  const auto file = read_rig(rig, options);
  if (file.index() == 1) throw std::invalid_argument("rig_to_json: " + rig + " has faults");
  return rig_to_json(std::get<0>(file));
}

}  // namespace rvbench::bench
