#pragma once

#include <vector>

#include "hal/config_reader.hpp"
#include "sim/plant_spec.hpp"
#include "sim/rv_unit.hpp"

namespace rvbench::sim {

/// What the simulated bench calls the parts of the plant that it drives and looks at.
namespace rv_parts {
inline constexpr std::string_view motor = "motor";
inline constexpr std::string_view input_shaft = "input_shaft";
inline constexpr std::string_view carrier = "carrier";
inline constexpr std::string_view brake = "brake";
inline constexpr std::string_view supply = "supply";              ///< input: inverter's output, Hz
inline constexpr std::string_view brake_torque = "brake_torque";  ///< input: of the brake, N·m
}  // namespace rv_parts

/// Steps of the simulated bench: four for each sample of its DAQ resolve the 5 kHz planet mode.
inline constexpr double rv_step_rate_Hz = 4 * 4960;

/// The RV-20E's bench as it is on the drawing: plants/rv20e_bench.json.
const PlantSpec& rv20e_bench();

/// The plant with a brake that holds at standstill, in place of one that creeps there.
PlantSpec with_holding_brake(PlantSpec plant);

/// What keeps the simulated bench from running this plant: it needs the bodies and inputs above and
/// no other inputs, an induction_motor, a planet_mesh and a cycloid_stage for each planet, and a
/// term between motor and input shaft and one between carrier and brake, whose torques it measures.
/// The plant's outputs are no part of that: the bench has sensors of its own. Nor may a mode of it
/// be faster than the bench's steps resolve.
/// @return no faults if it can be run
std::vector<hal::ConfigFault> rv_plant_faults(const PlantSpec& plant,
                                              double step_rate_Hz = rv_step_rate_Hz);

/// The plant as one unit was built: its deviations, friction and slip. A deviation that the plant
/// states itself stands.
PlantSpec as_built(PlantSpec plant, const RvUnit& unit);

}  // namespace rvbench::sim
