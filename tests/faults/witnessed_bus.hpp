#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "hal/can_transport.hpp"
#include "tests/faults/plant_truth.hpp"

namespace rvbench::test {

/// The nodes' end of the bus, and what an analyser clipped to it would have seen.
class WitnessedBus final : public hal::CanTransport {
 public:
  /// @param bus  must outlive it, as must `torques`, which takes what the transducer sends
  WitnessedBus(hal::CanTransport& bus, std::function<double()> now_s,
               std::vector<PlantTruth::Torque>& torques)
      : bus_(bus), now_s_(std::move(now_s)), torques_(torques) {}

  Status open() override { return bus_.open(); }
  Status send(const hal::CanFrame& frame) override;
  Result<hal::CanFrame> receive() override;

  /// Whether the brake was told to let go since this was asked last.
  bool take_release() { return std::exchange(saw_release_, false); }

 private:
  hal::CanTransport& bus_;
  std::function<double()> now_s_;
  std::vector<PlantTruth::Torque>& torques_;
  bool saw_release_ = false;
};

/// The bench's end of a bus whose controller may go bus-off: then it says disconnected until it is
/// opened again.
class FragileBus final : public hal::CanTransport {
 public:
  /// @param is_off  must outlive it
  FragileBus(std::unique_ptr<hal::CanTransport> bus, bool& is_off)
      : bus_(std::move(bus)), is_off_(is_off) {}

  Status open() override;
  Status send(const hal::CanFrame& frame) override;
  Result<hal::CanFrame> receive() override;

 private:
  std::unique_ptr<hal::CanTransport> bus_;
  bool& is_off_;
};

}  // namespace rvbench::test
