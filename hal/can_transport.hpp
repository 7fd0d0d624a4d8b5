#pragma once

#include <array>
#include <cstdint>

#include "hal/types/result.hpp"

namespace rvbench::hal {

struct CanFrame {
  std::uint32_t id = 0;  ///< 11-bit identifier
  std::uint8_t length = 0;
  std::array<std::uint8_t, 8> data{};
  double time_s = 0;  ///< when it was received, on the rig's clock; ignored by send()
};

/// One end of a classic CAN bus: whole frames in and out.
///
/// Order    open() → { send() | receive() }* → close by destruction
/// Threads  one caller at a time
class CanTransport {
 public:
  virtual ~CanTransport() = default;
  virtual Status open() = 0;
  virtual Status send(const CanFrame& frame) = 0;

  /// The next frame waiting; IoErrc::timeout if there is none now (it does not wait).
  virtual Result<CanFrame> receive() = 0;
};

}  // namespace rvbench::hal
