#include "hal/simulated_rig.hpp"

#include <stdexcept>
#include <utility>

#include "hal/can/can_brake.hpp"
#include "hal/can/can_dispatcher.hpp"
#include "hal/can/can_frames.hpp"
#include "hal/can/can_torque_sensor.hpp"
#include "hal/daq_accelerometers.hpp"
#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"

namespace rvbench::hal {
namespace {

class PlantClock final : public Clock {
 public:
  explicit PlantClock(PlantPort& port) : port_(port) {}
  double now_s() const override { return port_.now_s(); }
  void wait_until(double time_s) override { port_.advance_to(time_s); }
  bool is_virtual() const override { return true; }

 private:
  PlantPort& port_;
};

class PlantSafetyInputs final : public SafetyInputs {
 public:
  explicit PlantSafetyInputs(const PlantPort& port) : port_(port) {}

  Status connect() override {
    connected_ = true;
    return Done{};
  }

  Result<SafetyStatus> read() override {
    if (!connected_) return IoError{IoErrc::disconnected, "safety inputs: read"};
    return port_.safety_status();
  }

 private:
  const PlantPort& port_;
  bool connected_ = false;
};

std::unique_ptr<Drive> make_drive(const PlantPort& port, const SimulatedRigOptions& options,
                                  Clock& clock) {
  return std::make_unique<ModbusInverter>(
      ModbusInverterOptions{.profile = drive_profile("rvbench_generic"),
                            .path = ModbusTcp{"127.0.0.1", port.inverter_tcp_port()},
                            .unit_id = options.inverter_unit_id,
                            .response_timeout_s = options.response_timeout_s,
                            .stall_s = options.stall_s,
                            .limits = options.drive,
                            .motor = {.pole_pairs = options.pole_pairs}},
      clock);
}

}  // namespace

Rig make_simulated_rig(std::unique_ptr<PlantPort> port, const SimulatedRigOptions& options) {
  if (!port) throw std::invalid_argument("make_simulated_rig: port is null");
  PlantPort& plant = *port;
  Rig rig;
  rig.name = "sim";
  rig.backstage = std::move(port);
  rig.clock = std::make_unique<PlantClock>(plant);
  Clock& clock = *rig.clock;
  rig.safety = std::make_unique<PlantSafetyInputs>(plant);
  rig.accelerometers = std::make_unique<DaqAccelerometers>(plant, clock, options.deadline_s);
  auto ports =
      split_by_id(plant.make_can_transport(), {can_frames::torque_id, can_frames::brake_status_id});
  rig.torque_sensor = std::make_unique<CanTorqueSensor>(
      std::move(ports[0]),
      CanTorqueSensorOptions{.rate_Hz = options.torque_rate_Hz, .deadline_s = options.deadline_s},
      clock);
  rig.brake = std::make_unique<CanBrake>(
      std::move(ports[1]),
      CanBrakeOptions{.limits = options.brake, .deadline_s = options.deadline_s}, clock);
  rig.drive = make_drive(plant, options, clock);
  return rig;
}

}  // namespace rvbench::hal
