#include "tests/latency/live_plant.hpp"

#include "hal/can/can_brake.hpp"
#include "hal/can/can_dispatcher.hpp"
#include "hal/can/can_frames.hpp"
#include "hal/can/can_torque_sensor.hpp"
#include "hal/daq_accelerometers.hpp"
#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"

namespace rvbench::test {
namespace {

constexpr double deadline_s = 0.2;

// The plant's own clock, which outlives the rig's devices.
class PlantsClock final : public hal::Clock {
 public:
  explicit PlantsClock(hal::Clock& clock) : clock_(clock) {}
  double now_s() const override { return clock_.now_s(); }
  void wait_until(double time_s) override { clock_.wait_until(time_s); }
  bool is_virtual() const override { return false; }

 private:
  hal::Clock& clock_;
};

// The bench's end of the bus asks the plant for the time: not while it steps.
class LockedTransport final : public hal::CanTransport {
 public:
  LockedTransport(std::unique_ptr<hal::CanTransport> bus, std::mutex& mutex)
      : bus_(std::move(bus)), mutex_(mutex) {}
  Status open() override { return bus_->open(); }
  Status send(const hal::CanFrame& frame) override {
    const std::lock_guard lock(mutex_);
    return bus_->send(frame);
  }
  Result<hal::CanFrame> receive() override { return bus_->receive(); }

 private:
  std::unique_ptr<hal::CanTransport> bus_;
  std::mutex& mutex_;
};

class LiveSafetyInputs final : public hal::SafetyInputs {
 public:
  explicit LiveSafetyInputs(const LivePlant& plant) : plant_(plant) {}
  Status connect() override { return Done{}; }
  Result<hal::SafetyStatus> read() override { return plant_.safety_status(); }

 private:
  const LivePlant& plant_;
};

}  // namespace

LivePlant::LivePlant(const sim::InverterParameters& inverter)
    : bench_(1, inverter),
      tap_(bench_.inverter_tcp_port(), [this] { return clock_.now_s(); }),
      thread_([this](const std::stop_token& stop) {
        for (double next_s = clock_.now_s(); !stop.stop_requested(); next_s += 0.001) {
          clock_.wait_until(next_s);
          const std::lock_guard lock(mutex_);
          bench_.advance_to(clock_.now_s());
        }
      }) {}

LivePlant::~LivePlant() {
  thread_.request_stop();
  thread_.join();
}

std::unique_ptr<hal::CanTransport> LivePlant::make_can_transport() {
  return std::make_unique<LockedTransport>(
      look([](FaultBench& bench) { return bench.make_can_transport(); }), mutex_);
}

const std::vector<ChannelInfo>& LivePlant::acceleration_channels() const {
  return bench_.acceleration_channels();  // they never change
}

hal::AccelerationBlock LivePlant::take_accelerations() {
  return look([](FaultBench& bench) { return bench.take_accelerations(); });
}

hal::SafetyStatus LivePlant::safety_status() const {
  return look([](const FaultBench& bench) { return bench.safety_status(); });
}

hal::Rig make_live_plant_rig(const sim::InverterParameters& inverter) {
  hal::Rig rig;
  rig.name = "live plant";
  auto plant = std::make_unique<LivePlant>(inverter);
  rig.clock = std::make_unique<PlantsClock>(plant->clock());
  hal::Clock& clock = *rig.clock;
  rig.safety = std::make_unique<LiveSafetyInputs>(*plant);
  rig.accelerometers = std::make_unique<hal::DaqAccelerometers>(*plant, clock, deadline_s);
  auto ports = hal::split_by_id(plant->make_can_transport(),
                                {hal::can_frames::torque_id, hal::can_frames::brake_status_id});
  rig.torque_sensor = std::make_unique<hal::CanTorqueSensor>(
      std::move(ports[0]), hal::CanTorqueSensorOptions{.deadline_s = deadline_s}, clock);
  rig.brake = std::make_unique<hal::CanBrake>(
      std::move(ports[1]), hal::CanBrakeOptions{.deadline_s = deadline_s}, clock);
  rig.drive = std::make_unique<hal::ModbusInverter>(
      hal::ModbusInverterOptions{.profile = hal::drive_profile("rvbench_generic"),
                                 .path = hal::ModbusTcp{"127.0.0.1", plant->inverter_tcp_port()},
                                 .response_timeout_s = 0.05},
      clock);
  rig.backstage = std::move(plant);
  return rig;
}

LivePlant& live_plant(hal::Rig& rig) { return static_cast<LivePlant&>(*rig.backstage); }

}  // namespace rvbench::test
