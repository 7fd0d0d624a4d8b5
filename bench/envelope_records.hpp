#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <variant>
#include <vector>

#include "analysis/squared_envelope.hpp"
#include "bench/campaign.hpp"
#include "bench/envelope_features.hpp"
#include "hal/config_reader.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// A record of a random vibration, in stretches of equal length.
struct EnvelopeRecord {
  RecordLabels about;
  Eigen::VectorXd inputs;  ///< constant, of the plant's channels
  double shaft_Hz = 0;
  std::vector<VibrationBlock> blocks;
  std::vector<std::vector<analysis::DepthNear>> depths;  ///< per block: of each output's lines
  std::vector<Eigen::VectorXd> values;                   ///< per block: see read_features()
  Eigen::VectorXd errors;                                ///< of each block's values
};

/// Cuts a record into stretches of turns_per_block turns of the shaft, eight at most.
/// @param shaft  input that is the shaft's speed, in Hz
/// @return every reason why it cannot be compared: channels missing or clipped, a band that the
///         rate does not hold, a shaft that stands still or runs up, too few turns
std::variant<EnvelopeRecord, std::vector<hal::ConfigFault>> measure_envelopes(
    const sim::PlantSpec& plant, std::size_t shaft, const CampaignRecord& of);

/// Fills in depths, values and errors: of each output the levels of its parts [dB], then the depths
/// of its lines.
/// @param orders  of the shaft: per output, lines to compare
void read_features(const std::vector<std::vector<double>>& orders, EnvelopeRecord& record);

}  // namespace rvbench::bench
