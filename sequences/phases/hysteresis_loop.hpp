#pragma once

#include <memory>

#include "hal/config_reader.hpp"
#include "sequences/phase.hpp"

namespace rvbench::sequences {

/// Holds the output by the brake and winds the input to and fro, slowly: one point, whose torque
/// over angle is the hysteresis loop of the reducer.
///
/// The commanded speed rises evenly until the input torque asks for `peak_pct` of the rated one at
/// the output, then falls until it asks for as much the other way, and so on; last it returns to 0.
/// It leaves out speeds below `least_speed_rpm`, which a drive takes for a stop: the shaft would
/// spring back. A motor that slips thereby gives a torque that grows as slowly, and one that does
/// not slip winds as slowly. `peak_pct` is below `hold_pct`: the brake must not give way.
std::unique_ptr<Phase> parse_hysteresis_loop(hal::ConfigReader& json);

}  // namespace rvbench::sequences
