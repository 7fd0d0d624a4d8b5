#pragma once

#include <cstdint>
#include <memory>

#include "hal/brake.hpp"
#include "hal/drive.hpp"
#include "hal/plant_port.hpp"
#include "hal/rig.hpp"

namespace rvbench::hal {

/// What the bench believes about its devices; it must agree with the plant behind the port.
struct SimulatedRigOptions {
  DriveLimits drive{.max_speed_rpm = 3000};
  int pole_pairs = 2;
  std::uint8_t inverter_unit_id = 1;
  double response_timeout_s = 0.1;  ///< of the inverter, rig time
  double stall_s = 0.2;             ///< real time that a busy computer may hold an answer up
  BrakeLimits brake{.max_torque_Nm = 600};
  double torque_rate_Hz = 500;  ///< of the transducer's frames
  double deadline_s = 0.2;      ///< how old a value of any other device may be, rig time
};

/// The real drivers over a simulated plant: Modbus TCP to the plant's inverter, CAN frames to its
/// transducer and brake; accelerometers and safety inputs straight from the port. Time is virtual:
/// it moves the plant, and only inside Clock::wait_until().
///
/// The rig owns the port as its backstage. Only Drive::stop() may come from another thread.
/// @throws std::invalid_argument if port is null or an option is out of range
Rig make_simulated_rig(std::unique_ptr<PlantPort> port, const SimulatedRigOptions& options = {});

}  // namespace rvbench::hal
