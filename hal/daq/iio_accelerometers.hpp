#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/clock.hpp"
#include "hal/daq/daq_input.hpp"
#include "hal/daq/streamed_accelerometers.hpp"

namespace rvbench::hal {

struct IioOptions {
  std::string uri;     ///< "ip:192.168.1.5", "ip:127.0.0.1:30431", "local:"
  std::string device;  ///< its name or id: "ad7768-1", "iio:device0"
  std::vector<DaqInput> inputs;
  double rate_Hz = 4960;    ///< asked for; the device may take the nearest it has
  double range_m_s2 = 490;  ///< full scale of the sensors, as far as the converter goes
  double block_s = 0.005;   ///< of scans that come together
  double deadline_s = 0.2;
};

/// Accelerometers on a front end of the Linux industrial I/O subsystem, in this machine or behind
/// iiod in another. Over libiio 0.24, whose own names these are.
///
/// Values   raw count of the channel (its own format) + its `offset`, times its `scale`. Of a
///          voltage channel that makes millivolts, and the input's sensitivity m/s² of them; of a
///          channel of acceleration m/s² (Linux: Documentation/ABI/testing/sysfs-bus-iio).
///          An attribute that the channel does not have is 1 (scale) or 0 (offset)
/// Rate     written to `sampling_frequency` of the device, or of its channels, and read back
/// Range    the sensors' full scale, or what the converter reaches in both directions, offset and
///          scale included, where that is less
/// Errors   refused (connect): no such device, channel or rate, with what there is, or an attribute
///          that cannot be read; bad_reply (connect): one that is no number; disconnected: no
///          context, or the link broke. The connection itself may take 2 s
/// @throws std::invalid_argument naming the option that is out of range
std::unique_ptr<StreamedAccelerometers> make_iio_accelerometers(IioOptions options, Clock& clock);

}  // namespace rvbench::hal
