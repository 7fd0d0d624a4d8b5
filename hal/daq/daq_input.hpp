#pragma once

#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::hal {

/// One input of a DAQ device with the sensor on it.
struct DaqInput {
  std::string device_channel;  ///< as the device calls it: "voltage0", "3"
  ChannelInfo info;            ///< unit "m/s²"; a sensitivity where the device tells volts
};

}  // namespace rvbench::hal
