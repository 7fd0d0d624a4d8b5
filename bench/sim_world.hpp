#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bench/rig_file.hpp"
#include "hal/config_reader.hpp"
#include "sim/bench_world.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// Faults of a plant, at the key of the rig file that names it.
std::vector<hal::ConfigFault> at_plant(const std::string& plant,
                                       const std::vector<hal::ConfigFault>& own);

/// The plant that a simulated bench turns, or its faults.
std::variant<sim::PlantSpec, std::vector<hal::ConfigFault>> runnable_plant(const SimRig& rig);

/// The simulated bench of a rig file, its faults still to be scheduled; or what is wrong with it.
/// @param inverter_port  of its inverter's server; 0: the kernel chooses one
std::variant<std::unique_ptr<sim::BenchWorld>, std::vector<hal::ConfigFault>> make_world(
    const SimRig& rig, std::uint16_t inverter_port = 0);

/// The channels of a simulated bench that somebody may calibrate.
std::vector<ChannelInfo> channels_of(const SimRig& rig);

/// The fault of that name: "late", "silent", "garbled", "busy", "dead"; "none" heals.
/// @throws std::out_of_range if there is none of that name
sim::WireFault wire_fault(std::string_view name);

/// The names of all.
std::vector<std::string_view> wire_fault_names();

}  // namespace rvbench::bench
