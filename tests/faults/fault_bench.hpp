#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "hal/can/in_process_transport.hpp"
#include "hal/plant_port.hpp"
#include "sim/brake_node.hpp"
#include "sim/inverter_model.hpp"
#include "sim/inverter_server.hpp"
#include "sim/transducer_node.hpp"
#include "tests/faults/witnessed_bus.hpp"

namespace rvbench::test {

/// What the sequencer is doing, as the plant can tell from what happens to it.
enum class BenchState {
  connecting,
  arming,
  warming_up,
  settling,
  recording,
  settling_again,   ///< for the second point
  recording_again,  ///< that one
  stopping
};

inline constexpr int bench_states = 8;

const char* to_string(BenchState state);

/// Everything that can be made to misbehave and is no device's own fault mode.
struct Disturbance {
  bool channel_open = false;     ///< accelerometer cable open: the input drifts to its rail
  bool channel_flat = false;     ///< accelerometer dead: 0
  bool channel_clipped = false;  ///< amplifier too high: cut at full scale
  bool spike = false;            ///< one sample near full scale
  bool mains_hum = false;        ///< ground loop: 50 Hz and its odd harmonics
  bool drifts = false;           ///< charge amplifier integrates its leak
  bool iepe_off = false;         ///< no supply: nothing but the front end's noise,
  double bias_jump_m_s2 = 0;     ///< and what AC coupling leaves of a bias that breaks down
  bool scans_lost = false;       ///< every tenth scan is NaN
  int scans_to_lose = 0;         ///< the next ones are NaN
  int scans_to_swallow = 0;      ///< the next ones are missing, and nobody says so
  bool daq_stopped = false;
  bool daq_fast = false;         ///< its clock runs 5 % fast
  bool torque_inverted = false;  ///< the transducer's sign
  bool over_torque = false;      ///< 100 N·m at the input
  bool angle_stuck = false;      ///< the encoder's shaft is broken: the angle stands still
  bool torque_lossy = false;     ///< every tenth frame of the transducer is lost
  bool speed_stuck = false;      ///< the drive's speed register shows what it last showed
  bool bus_off = false;          ///< the bench's CAN controller, until it is opened again
  double stall_s = 0;            ///< the controller gets no time for that long
};

/// A bench with just enough physics to be judged by: a shaft with inertia that follows the
/// inverter's field with slip, coasts when the output is off, and is held back by the brake. Fast
/// enough for thousands of runs; its devices are reached over the real protocols.
class FaultBench final : public hal::PlantPort {
 public:
  static constexpr double rate_Hz = 1240;
  static constexpr double range_m_s2 = 490;
  static constexpr double gear_ratio = 121;
  /// After a speed was asked for: the field's ramp and the settling are over by then.
  static constexpr double record_after_s = 6;
  static constexpr double moves_rpm = 5;  ///< slower is standstill: the plan's own default

  FaultBench(std::uint64_t seed, const sim::InverterParameters& parameters);

  double now_s() const override { return time_s_; }
  void advance_to(double time_s) override;
  std::uint16_t inverter_tcp_port() const override { return server.port(); }
  std::unique_ptr<hal::CanTransport> make_can_transport() override;
  const std::vector<ChannelInfo>& acceleration_channels() const override { return channels_; }
  double acceleration_rate_Hz() const override { return rate_Hz; }
  double acceleration_range_m_s2() const override { return range_m_s2; }
  hal::AccelerationBlock take_accelerations() override;
  hal::SafetyStatus safety_status() const override {
    safety_was_read_ = true;
    return safety;
  }

  /// Does it `after_s` seconds after that state was entered for the first time.
  void when(BenchState state, double after_s, std::function<void()> what);

  // For the oracle: the truth, whatever any device says.
  double speed_rpm() const;  // of the input shaft
  double brake_Nm() const { return brake.setpoint_Nm(); }
  /// Somebody wants the shaft to turn, and current flows. Not while a drive that has taken a stop
  /// brakes by its ramp.
  bool is_driven() const;
  double driven_until_s() const { return driven_until_s_; }  ///< last time that it was
  double moved_until_s() const { return moved_until_s_; }    ///< last time above 5 rpm
  double braked_until_s() const { return braked_until_s_; }  ///< last time with torque commanded
  double released_s() const { return released_s_; }      ///< when the brake was last told to let go
  double released_rpm() const { return released_rpm_; }  ///< how fast the shaft turned then
  bool was(BenchState state) const { return entered_s(state) >= 0; }
  double entered_s(BenchState state) const;  ///< NaN if it never was

  PlantTruth truth;  ///< what left the sensors so far

  sim::InverterModel inverter;
  sim::InverterServer server;
  hal::InProcessBus bus;
  WitnessedBus wire;
  sim::TransducerNode transducer;
  sim::BrakeNode brake;
  hal::SafetyStatus safety{.estop_pressed = false, .guard_open = false, .housing_temp_degC = 25};
  Disturbance disturbance;

 private:
  struct Trigger {
    BenchState state;
    double after_s;
    std::function<void()> what;
  };

  void step();
  void turn(double dt_s);
  void sample();
  float spoilt(float value);  ///< as the channel shows it that is at fault
  void follow_states();
  void enter(BenchState state);
  void fire_triggers();

  double time_s_ = 0;
  long steps_ = 0;
  double speed_rad_s_ = 0;
  double angle_rad_ = 0;
  double shown_angle_rad_ = 0;
  double input_torque_Nm_ = 0;
  double drifted_m_s2_ = 0;
  double setpoint_Hz_ = 0;
  int speeds_asked_ = 0;  ///< one after the other, other than 0
  mutable bool safety_was_read_ = false;
  double driven_until_s_ = 0, moved_until_s_ = 0, braked_until_s_ = 0;
  double released_s_ = not_known, released_rpm_ = not_known;
  std::map<BenchState, double> entered_s_;
  std::vector<Trigger> triggers_;
  std::vector<float> waiting_;
  long taken_ = 0;
  std::mt19937_64 random_;
  std::normal_distribution<float> noise_{0, 0.5F};
  std::vector<ChannelInfo> channels_;
};

}  // namespace rvbench::test
