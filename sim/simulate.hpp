#pragma once

#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"
#include "sim/excitation.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

/// What a plant's sensors show for one record of its inputs.
struct Simulated {
  std::vector<Channel> channels;  ///< one per output, at the rate and with the start of the inputs
  int substeps = 1;               ///< per sample, as made
  double substeps_wanted = 1;     ///< more than made: too coarse for what the plant has become
};

using SimulatedOrFault = std::variant<Simulated, hal::ConfigFault>;

/// Steps per sample at which simulate() is accurate for this plant (see FourStage): what
/// Excitation::make() needs to know. A fault if more than 10000 would be needed.
std::variant<int, hal::ConfigFault> substeps_for(const PlantSpec& plant, double rate_Hz,
                                                 const TermLibrary& library = standard_terms());

/// Runs a plant along recorded inputs, sample by sample. The same call gives the same bits.
///
/// @return the outputs; or what stands in the way, with the JSON pointer of the plant's part: see
///         check_plant(), Excitation::make(), and a plant that leaves all bounds
SimulatedOrFault simulate(const PlantSpec& plant, const Excitation& excitation,
                          const TermLibrary& library = standard_terms());

/// The same for a single run: chooses the steps.
SimulatedOrFault simulate(const PlantSpec& plant, const std::vector<Channel>& inputs,
                          const TermLibrary& library = standard_terms());

}  // namespace rvbench::sim
