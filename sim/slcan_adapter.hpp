#pragma once

#include <memory>
#include <string>

#include "hal/can_transport.hpp"

namespace rvbench::sim {

/// How a serial CAN adapter misbehaves, until it is told otherwise.
enum class SlcanFault {
  none,
  silent,   ///< answers nothing and hands no frame on, either way
  garbled,  ///< what it says has bytes that belong to no line
  bus_off,  ///< its controller has left the bus: the flags say so, no frame passes
  slow_ack  ///< acknowledges a frame 500 ms after it has sent it
};

/// A serial CAN adapter with the LAWICEL ASCII protocol, behind a pseudo-terminal and in front of
/// one end of a bus; the nodes have the other end.
///
/// Commands  S0 to S8, O, L, C, t, T, r, R, F, V, N, Z0, Z1, each ended by CR. Answered with CR,
///           the frames' with "z" or "Z" before it; with BEL if it is no command, or not one for
///           now: the bit rate is set while the channel is closed, frames pass while it is open
/// Frames    only those that the bus knows: T, r and R are acknowledged, and no node hears them
/// Queue     what the client does not fetch waits, up to 4096 bytes; what comes then is lost, and
///           the flags say so
/// Time      frames are handed on within 1 ms of real time
/// Threads   serves in a thread of its own from construction to destruction; the bus must allow
///           its other end in another thread, and its clock must be safe to ask in both
class SlcanAdapter {
 public:
  /// @param bus  must outlive the adapter; it is the only one that receives from this end
  /// @throws std::runtime_error if there is no pseudo-terminal to be had
  explicit SlcanAdapter(hal::CanTransport& bus);
  ~SlcanAdapter();

  SlcanAdapter(const SlcanAdapter&) = delete;
  SlcanAdapter& operator=(const SlcanAdapter&) = delete;

  /// What a client opens: "/dev/pts/3".
  const std::string& device() const;

  void inject(SlcanFault fault);

  /// Has the next F tell these flags too, once: 0x08 data overrun, 0x80 bus error.
  void raise_flags(unsigned flags);

  /// Puts bytes on the line that nobody asked for: "sb000256\r".
  void say(const std::string& bytes);

  int bitrate_code() const;  ///< of the last S command; -1 before the first
  bool is_channel_open() const;
  int frames_to_bus() const;    ///< since construction
  int frames_from_bus() const;  ///< since construction, those that were lost among them

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace rvbench::sim
