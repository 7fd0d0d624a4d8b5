#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "hal/plant_port.hpp"
#include "sim/anti_alias_filter.hpp"
#include "sim/brake_node.hpp"
#include "sim/inverter_model.hpp"
#include "sim/inverter_server.hpp"
#include "sim/rv_bench.hpp"
#include "sim/transducer_node.hpp"

namespace rvbench::sim {

/// The twelve inputs of the simulated bench's DAQ: four triaxial accelerometers.
std::vector<ChannelInfo> triaxial_channels();

/// The simulated bench as the HAL meets it: the RV-20E train behind a real Modbus inverter, a CAN
/// transducer and brake, a DAQ and safety inputs. Time moves only in advance_to().
///
/// Torque   behind the transducer's anti-alias filter, with its noise; the angle is counted, and
///          has neither
/// Threads  one caller at a time, and another one at the bench's end of the bus; the inverter's
///          server has a thread of its own
class BenchWorld final : public hal::PlantPort {
 public:
  /// @param unit  how what turns deviates from the drawing
  /// @param plant  the drawing
  /// @param inverter_port  of the inverter's server; 0: the kernel chooses one
  /// @throws std::invalid_argument if the bench cannot run the plant
  explicit BenchWorld(RvUnit unit, const InverterParameters& inverter = {},
                      const PlantSpec& plant = rv20e_bench(), std::uint16_t inverter_port = 0);

  double now_s() const override { return now_s_; }
  void advance_to(double time_s) override;
  std::uint16_t inverter_tcp_port() const override { return server_.port(); }
  std::unique_ptr<hal::CanTransport> make_can_transport() override;
  const std::vector<ChannelInfo>& acceleration_channels() const override { return channels_; }
  double acceleration_rate_Hz() const override { return RvBench::rate_Hz; }
  /// As the article's list of instruments has it for the PCB 356A16.
  double acceleration_range_m_s2() const override { return 1000; }
  hal::AccelerationBlock take_accelerations() override;
  hal::SafetyStatus safety_status() const override;

  // For tests that make the world misbehave, or look behind the scenes.
  InverterServer& inverter_server() { return server_; }
  InverterModel& inverter() { return inverter_; }
  TransducerNode& transducer() { return *transducer_; }
  BrakeNode& brake() { return *brake_; }
  const RvTrain& plant() const { return plant_.train(); }
  void tap_housing() { plant_.tap_housing(); }
  void press_estop(bool pressed = true) { estop_pressed_ = pressed; }
  void open_guard(bool open = true) { guard_open_ = open; }
  void stop_daq(bool stopped = true) { daq_stopped_ = stopped; }
  void lose_temperature(bool lost = true) { housing_temp_is_known_ = !lost; }

  /// Does it once time has come to `time_s`: in the middle of advance_to(), or now if it has.
  void at(double time_s, std::function<void()> what);

 private:
  static constexpr double hall_degC = 22;  ///< assumed

  void step();
  double torque_noise_Nm();
  void heat(double dt_s);

  RvBench plant_;
  InverterModel inverter_;
  InverterServer server_;
  std::unique_ptr<hal::CanTransport> bench_end_, node_end_;
  std::unique_ptr<TransducerNode> transducer_;
  std::unique_ptr<BrakeNode> brake_;
  AntiAliasFilter torque_filter_;
  std::mt19937_64 torque_engine_;
  std::normal_distribution<double> torque_noise_;
  std::vector<ChannelInfo> channels_;

  std::atomic<double> now_s_ = 0;  ///< the bus asks for it from wherever frames are sent
  std::int64_t scans_ = 0;         ///< sampled since the start
  std::int64_t taken_ = 0;         ///< handed over
  std::vector<float> waiting_;
  Eigen::VectorXf scan_;
  double housing_temp_degC_ = hall_degC;
  bool estop_pressed_ = false;
  bool guard_open_ = false;
  bool daq_stopped_ = false;
  bool housing_temp_is_known_ = true;
  std::multimap<double, std::function<void()>> events_;
};

}  // namespace rvbench::sim
