#pragma once

#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::hal {

/// One input of a DAQ device with the sensor on it.
struct DaqInput {
  std::string device_channel;  ///< as the device calls it: "voltage0", "3"
  ChannelInfo info;            ///< unit "m/s²"
  /// Of what the device tells: m/s² per V of comedi; per mV of a voltage channel of libiio, which
  /// Linux scales so; 1 where it tells m/s².
  double m_s2_per_unit = not_known;
};

}  // namespace rvbench::hal
