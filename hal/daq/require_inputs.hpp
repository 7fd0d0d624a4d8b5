#pragma once

#include <fmt/format.h>

#include <vector>

#include "hal/daq/daq_input.hpp"
#include "hal/types/require.hpp"

namespace rvbench::hal {

/// What front ends of every kind ask of their options.
/// @throws std::invalid_argument as `require` does
inline void require_inputs(const Require& require, const std::vector<DaqInput>& inputs,
                           double range_m_s2, double block_s) {
  require(!inputs.empty(), "no inputs");
  require(range_m_s2 > 0, fmt::format("range_m_s2 is {}", range_m_s2));
  require(block_s > 0 && block_s <= 0.2,
          fmt::format("block_s is {}, must be above 0, at most 0.2", block_s));
  for (const DaqInput& input : inputs) {
    require(input.info.sensitivity != 0,
            fmt::format("sensitivity of {} is 0", input.device_channel));
  }
}

}  // namespace rvbench::hal
