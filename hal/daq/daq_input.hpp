#pragma once

#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::hal {

/// One input of a DAQ device with the sensor on it.
struct DaqInput {
  std::string device_channel;  ///< as the device calls it: "voltage0", "3"
  ChannelInfo info;            ///< unit "m/s²"
  double m_s2_per_unit =
      not_known;  ///< of what the device tells: m/s² per V, or 1 if it tells m/s²
};

}  // namespace rvbench::hal
