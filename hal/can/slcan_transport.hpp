#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/bus_monitor.hpp"
#include "hal/can_transport.hpp"
#include "hal/clock.hpp"

namespace rvbench::hal {

class SlcanLink;

struct SlcanOptions {
  std::string device;        ///< "/dev/ttyUSB0"
  int bitrate_kbit_s = 250;  ///< of the bus: one of the protocol's nine, S0 (10) to S8 (1000)
  int baud = 115200;         ///< of the line; adapters on USB take any
  std::vector<std::uint32_t> ids = {};  ///< 11-bit identifiers that come in; nothing else does
};

/// Classic CAN through a serial adapter that speaks the LAWICEL ASCII protocol, where the kernel
/// has no driver for it.
///
/// Errors   disconnected: no such device, another program has it, the line hung up, the adapter
///          fell silent or its controller went bus-off. Then it stays disconnected until open() is
///          called again. refused (open only): the adapter tells no status flags, so nobody would
///          hear of a bus-off. overrun: the adapter lost frames. bad_reply: a line was garbled, and
///          with it maybe a frame
/// Sending  one frame at a time: the next is refused (timeout) while the one before has not been
///          acknowledged, and send() waits 2 ms at most for that. A frame that the adapter
///          declines makes the next call tell overrun
/// Time     open() waits 2 s at most, and drops whatever waited in the line. Frames carry the time
///          at which they were read from the line, so ask often
/// Threads  one caller at a time; its monitor may be read in another thread meanwhile
class SlcanTransport final : public CanTransport {
 public:
  /// @param clock  must outlive the transport and its monitor
  /// @throws std::invalid_argument naming the option that is out of range
  SlcanTransport(const SlcanOptions& options, const Clock& clock);
  ~SlcanTransport() override;

  SlcanTransport(const SlcanTransport&) = delete;
  SlcanTransport& operator=(const SlcanTransport&) = delete;

  Status open() override;
  Status send(const CanFrame& frame) override;
  Result<CanFrame> receive() override;

  /// Counts what the adapter has told since construction. It may outlive the transport, and tells
  /// disconnected then.
  std::unique_ptr<BusMonitor> monitor() const;

 private:
  std::shared_ptr<SlcanLink> link_;
};

}  // namespace rvbench::hal
