#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/can_transport.hpp"
#include "hal/clock.hpp"

namespace rvbench::hal {

/// Classic CAN over a Linux network interface ("can0", "vcan0"), raw and non-blocking.
///
/// Filter   only the given 11-bit identifiers come in, and the controller's error frames
/// Errors   disconnected: no such interface, no CAN in this kernel, interface down, bus-off. After
///          bus-off it stays disconnected until open() is called again: nothing resumes by itself.
///          overrun: the send queue is full, or the kernel dropped received frames
/// Time     frames carry the kernel's time of arrival, moved to the rig's clock
class SocketcanTransport final : public CanTransport {
 public:
  /// @param clock  must outlive the transport
  /// @throws std::invalid_argument if the name is empty or longer than the kernel allows, or an
  ///         identifier has more than 11 bits
  SocketcanTransport(std::string interface, std::vector<std::uint32_t> ids, const Clock& clock);
  ~SocketcanTransport() override;

  SocketcanTransport(const SocketcanTransport&) = delete;
  SocketcanTransport& operator=(const SocketcanTransport&) = delete;

  Status open() override;
  Status send(const CanFrame& frame) override;
  Result<CanFrame> receive() override;

 private:
  Status configure();
  Status bind_to_interface();
  IoError failure(const char* operation, int error) const;
  void close();

  std::string interface_;
  std::vector<std::uint32_t> ids_;
  const Clock& clock_;
  int socket_ = -1;
  std::uint32_t dropped_ = 0;  ///< by the kernel since open(), as it last said
};

}  // namespace rvbench::hal
