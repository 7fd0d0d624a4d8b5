#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/can_transport.hpp"
#include "hal/clock.hpp"

namespace rvbench::hal {

/// Classic CAN over a Linux network interface ("can0", "vcan0"), raw and non-blocking.
///
/// Filter   only the given 11-bit identifiers come in, and the controller's error frames
/// Errors   disconnected: no such interface, no CAN in this kernel, interface down, bus-off, a
///          controller that was restarted, a send queue that is full while nobody on the bus
///          listens. Then it stays disconnected until open() is called again: nothing resumes by
///          itself, nor while interface or controller are still off the bus. overrun: the send
///          queue is full, or frames were dropped on their way in
/// Sending  one frame at a time: the next is refused (timeout) while the one before has not been
///          on the bus, and send() waits 2 ms at most for that. open() is refused likewise. So no
///          setpoint waits in a queue to be sent when nobody means it any more
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
  Result<int> open_socket();
  Status configure_receiver();
  bool is_on_bus() const;
  Status watch_own(std::uint32_t id);
  bool has_left();
  std::optional<IoError> bus_error(std::uint32_t kind, std::uint8_t controller);
  IoError failure(const char* operation, int error) const;
  void close();

  std::string interface_;
  std::vector<std::uint32_t> ids_;
  const Clock& clock_;
  int receiver_ = -1;
  int sender_ = -1;                      ///< hears its own frames only, when they are on the bus
  std::vector<std::uint32_t> sent_ids_;  ///< that it hears
  std::uint32_t dropped_ = 0;            ///< by the kernel since open(), as it last said
  bool is_leaving_ = false;              ///< a frame was sent, and not yet seen on the bus
  bool is_passive_ = false;  ///< the controller has met so many errors that it keeps back
};

}  // namespace rvbench::hal
