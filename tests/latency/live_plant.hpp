#pragma once

#include <memory>
#include <mutex>
#include <thread>

#include "hal/plant_port.hpp"
#include "hal/rig.hpp"
#include "hal/steady_clock.hpp"
#include "tests/faults/fault_bench.hpp"
#include "tests/latency/wire_tap.hpp"

namespace rvbench::test {

/// The light bench of the fault campaign in real time: a thread of its own turns it, once a
/// millisecond, and real drivers reach it over their protocols.
class LivePlant final : public hal::PlantPort {
 public:
  explicit LivePlant(const sim::InverterParameters& inverter);
  ~LivePlant() override;

  double now_s() const override { return clock_.now_s(); }
  void advance_to(double) override {}  // it turns by itself
  std::uint16_t inverter_tcp_port() const override { return tap_.port(); }
  std::unique_ptr<hal::CanTransport> make_can_transport() override;
  const std::vector<ChannelInfo>& acceleration_channels() const override;
  double acceleration_rate_Hz() const override { return FaultBench::rate_Hz; }
  double acceleration_range_m_s2() const override { return FaultBench::range_m_s2; }
  hal::AccelerationBlock take_accelerations() override;
  hal::SafetyStatus safety_status() const override;

  hal::Clock& clock() { return clock_; }
  WireTap& tap() { return tap_; }

  /// Looks at the bench, or changes it, while it stands still.
  template <typename Look>
  auto look(Look&& look) const {
    const std::lock_guard lock(mutex_);
    return look(bench_);
  }

 private:
  mutable hal::SteadyClock clock_;
  mutable std::mutex mutex_;
  mutable FaultBench bench_;
  WireTap tap_;
  std::jthread thread_;
};

/// A rig of real drivers over a LivePlant, which is its backstage.
hal::Rig make_live_plant_rig(const sim::InverterParameters& inverter);
LivePlant& live_plant(hal::Rig& rig);

}  // namespace rvbench::test
