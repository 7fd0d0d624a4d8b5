#pragma once

#include <utility>

#include "hal/can_transport.hpp"

namespace rvbench::test {

/// The nodes' end of the bus, and what an analyser clipped to it would have seen.
class WitnessedBus final : public hal::CanTransport {
 public:
  /// @param bus  must outlive it
  explicit WitnessedBus(hal::CanTransport& bus) : bus_(bus) {}

  Status open() override { return bus_.open(); }
  Status send(const hal::CanFrame& frame) override { return bus_.send(frame); }
  Result<hal::CanFrame> receive() override {
    auto frame = bus_.receive();
    if (frame && frame.value().id == brake_command_id && frame.value().data[2] == 0) {
      saw_release_ = true;
    }
    return frame;
  }

  /// Whether the brake was told to let go since this was asked last.
  bool take_release() { return std::exchange(saw_release_, false); }

 private:
  static constexpr std::uint32_t brake_command_id = 0x201;

  hal::CanTransport& bus_;
  bool saw_release_ = false;
};

}  // namespace rvbench::test
