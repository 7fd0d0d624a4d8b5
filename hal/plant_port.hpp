#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal/accelerometers.hpp"
#include "hal/can_transport.hpp"
#include "hal/rig.hpp"
#include "hal/safety_inputs.hpp"

namespace rvbench::hal {

/// What a simulated bench must offer so that the roles can be played over it. The drive, the
/// torque transducer and the brake are reached by their real protocols; only what has no protocol
/// of its own (the DAQ's samples, the safety inputs, time) comes straight through here.
class PlantPort : public Backstage {
 public:
  virtual double now_s() const = 0;
  virtual void advance_to(double time_s) = 0;  ///< integrates; no-op if time_s has passed

  virtual std::uint16_t inverter_tcp_port() const = 0;  ///< Modbus server on 127.0.0.1

  /// The bench's end of the CAN bus; made once, owned by the caller.
  virtual std::unique_ptr<CanTransport> make_can_transport() = 0;

  virtual const std::vector<ChannelInfo>& acceleration_channels() const = 0;
  virtual double acceleration_rate_Hz() const = 0;
  virtual double acceleration_range_m_s2() const = 0;
  virtual AccelerationBlock take_accelerations() = 0;  ///< all scans since the last call
  virtual SafetyStatus safety_status() const = 0;
};

}  // namespace rvbench::hal
