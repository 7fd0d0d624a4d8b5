#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/accelerometers.hpp"
#include "hal/brake.hpp"
#include "hal/bus_monitor.hpp"
#include "hal/clock.hpp"
#include "hal/drive.hpp"
#include "hal/safety_inputs.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::hal {

/// Whatever must outlive the devices of a rig: a simulated world, an open recording.
class Backstage {
 public:
  virtual ~Backstage() = default;
};

/// The bench around the specimen: all that a sequencer gets. bench/rig_factory makes it.
/// Members are destroyed from the last to the first: devices, then the clock, then the backstage.
struct Rig {
  std::string name;
  bool is_played = false;                ///< a recording: nothing turns, and nothing can get hot
  std::unique_ptr<Backstage> backstage;  ///< may be null
  std::unique_ptr<Clock> clock;
  /// Of the devices; none where nothing is counted.
  std::vector<std::unique_ptr<BusMonitor>> buses;
  std::unique_ptr<SafetyInputs> safety;
  std::unique_ptr<Accelerometers> accelerometers;
  std::unique_ptr<TorqueSensor> torque_sensor;
  std::unique_ptr<Brake> brake;
  std::unique_ptr<Drive> drive;
  /// On a simulated bench: somebody taps on the housing now. Empty on others, where who works
  /// there is asked to.
  std::function<void()> tap_housing;
};

}  // namespace rvbench::hal
