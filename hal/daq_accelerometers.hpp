#pragma once

#include "hal/accelerometers.hpp"
#include "hal/clock.hpp"
#include "hal/plant_port.hpp"

namespace rvbench::hal {

/// The accelerometers of a simulated bench: the DAQ of a PlantPort as the role.
///
/// Errors   timeout: the DAQ gave no scan; bad_reply: a block with the wrong number of channels
/// Time     no call waits; an empty block is an error only when the deadline has passed
class DaqAccelerometers final : public Accelerometers {
 public:
  /// @param port   must outlive the accelerometers, and `clock` too
  /// @throws std::invalid_argument if deadline_s is not finite and positive
  DaqAccelerometers(PlantPort& port, Clock& clock, double deadline_s);

  const std::vector<ChannelInfo>& channels() const override;
  double range_m_s2() const override { return port_.acceleration_range_m_s2(); }
  double rate_Hz() const override { return port_.acceleration_rate_Hz(); }
  Status connect() override;
  Status start() override;
  Result<AccelerationBlock> read() override;
  void stop() noexcept override { running_ = false; }

 private:
  PlantPort& port_;
  Clock& clock_;
  double deadline_s_;
  bool connected_ = false;
  bool running_ = false;
  double fresh_s_ = 0;  ///< when a scan came last
};

}  // namespace rvbench::hal
