#include "bench/sim_world.hpp"

#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "sim/plant_json.hpp"
#include "sim/rv_plant.hpp"

namespace rvbench::bench {
namespace {

const std::map<std::string_view, sim::WireFault>& wire_faults() {
  static const std::map<std::string_view, sim::WireFault> faults{
      {"none", sim::WireFault::none},     {"late", sim::WireFault::late},
      {"silent", sim::WireFault::silent}, {"garbled", sim::WireFault::garbled},
      {"busy", sim::WireFault::busy},     {"dead", sim::WireFault::dead}};
  return faults;
}

}  // namespace

std::vector<hal::ConfigFault> at_plant(const std::string& plant,
                                       const std::vector<hal::ConfigFault>& own) {
  std::vector<hal::ConfigFault> faults;
  for (const hal::ConfigFault& fault : own) {
    faults.push_back({0, "/plant", hal::describe(plant, fault)});
  }
  return faults;
}

std::variant<sim::PlantSpec, std::vector<hal::ConfigFault>> runnable_plant(const SimRig& rig) {
  auto read = sim::read_plant(rig.plant);
  if (read.index() == 1) return at_plant(rig.plant, std::get<1>(read));
  sim::PlantSpec plant = std::get<0>(std::move(read));
  const auto faults = sim::rv_plant_faults(plant);
  if (!faults.empty()) return at_plant(rig.plant, faults);
  return rig.holding_brake ? sim::with_holding_brake(std::move(plant)) : plant;
}

std::variant<std::unique_ptr<sim::BenchWorld>, std::vector<hal::ConfigFault>> make_world(
    const SimRig& rig, std::uint16_t inverter_port) {
  const auto plant = runnable_plant(rig);
  if (plant.index() == 1) return std::get<1>(plant);
  try {
    return std::make_unique<sim::BenchWorld>(
        sim::draw_unit(rig.preset, rig.seed, rig.severity),
        sim::InverterParameters{.comm_loss_timeout_s = rig.watchdog_s}, std::get<0>(plant),
        inverter_port);
  } catch (const std::invalid_argument& error) {
    return std::vector<hal::ConfigFault>{{0, "/preset", error.what()}};
  }
}

std::vector<ChannelInfo> channels_of(const SimRig&) {
  std::vector<ChannelInfo> channels = sim::triaxial_channels();
  channels.push_back({std::string(channel_names::input_torque), "N·m", "", not_known});
  return channels;
}

sim::WireFault wire_fault(std::string_view name) { return wire_faults().at(name); }

std::vector<std::string_view> wire_fault_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, fault] : wire_faults()) names.push_back(name);
  return names;
}

}  // namespace rvbench::bench
