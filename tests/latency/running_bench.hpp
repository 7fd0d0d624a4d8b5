#pragma once

#include "sequences/bench_devices.hpp"
#include "sequences/plan.hpp"
#include "sequences/supervisor.hpp"
#include "tests/latency/live_plant.hpp"

namespace rvbench::test {

inline const sequences::Interlocks bench_limits{.input_speed_rpm = 2200,
                                                .input_torque_Nm = 8,
                                                .acceleration_m_s2 = 300,
                                                .housing_temp_degC = 60,
                                                .stale_after_s = 0.3};

/// A sequencer that does no more than it must: it asks the drive and feeds the watchdogs, every
/// 10 ms, and keeps the shaft at one speed.
class RunningBench {
 public:
  /// @throws std::runtime_error if the bench does not come to run
  RunningBench(hal::Rig& rig, double speed_rpm);

  void tick();
  void run_for(double duration_s);
  /// Goes on until the supervisor has latched an ending; false if none comes within ten seconds.
  bool run_until_tripped();
  sequences::Supervisor& supervisor() { return supervisor_; }

 private:
  hal::Rig& rig_;
  sequences::Supervisor supervisor_;
  sequences::BenchDevices devices_;
  double speed_rpm_ = 0;
  double next_tick_s_;
  double next_write_s_ = 0;
};

/// Connects every device. @throws std::runtime_error if one does not answer
void connect(hal::Rig& rig);

}  // namespace rvbench::test
