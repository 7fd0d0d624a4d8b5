#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/clock.hpp"
#include "hal/daq/daq_input.hpp"
#include "hal/daq/streamed_accelerometers.hpp"

namespace rvbench::hal {

struct ComediOptions {
  std::string device = "/dev/comedi0";
  std::vector<DaqInput> inputs;  ///< device_channel is a number; the same one may not come twice
  double rate_Hz = 4960;    ///< asked for; boards divide a clock, and take the nearest they can
  double range_V = 10;      ///< the smallest range of the board that holds -range_V to +range_V
  double range_m_s2 = 490;  ///< full scale of the sensors, as far as the board goes
  double block_s = 0.005;   ///< how often scans are fetched
  double deadline_s = 0.2;
};

/// Accelerometers on a data acquisition board that comedi drives, in this machine.
///
/// Values   volts of the input's range, ground referred, by the input's sensitivity; the ends
///          of the range are full scale, and clipped
/// Rate     as the board makes it of the one asked for: read back from its command
/// Errors   disconnected (connect): no device; refused: no inputs that scan, no such channel or
///          range, a rate that it cannot do; overrun: its buffer, of up to a second, ran over;
///          disconnected: it stopped by itself
/// @throws std::invalid_argument naming the option that is out of range
std::unique_ptr<StreamedAccelerometers> make_comedi_accelerometers(ComediOptions options,
                                                                   Clock& clock);

}  // namespace rvbench::hal
