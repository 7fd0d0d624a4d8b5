#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hal/types/recording.hpp"
#include "sequences/bench_loop.hpp"

namespace rvbench::bench {

/// What one sensor shows while nothing turns.
struct SensorAtRest {
  std::string name;
  std::string unit;
  long samples = 0;
  long lost = 0;
  double mean = 0;
  double squares = 0;  ///< sum, of what is off the mean: Welford (1962)
  double least = not_known, most = not_known;

  void take(double value);  ///< NaN: it was lost
  double rms() const;       ///< about the mean; NaN of fewer than two samples
  bool is_dead() const { return samples > 1 && least == most; }
};

/// The accelerometers, then the torque transducer, as nothing has been heard of them yet.
std::vector<SensorAtRest> sensors_of(const hal::Rig& rig);

/// Takes what has come in this tick of the loop.
void take_fresh(std::vector<SensorAtRest>& sensors, const sequences::FreshValues& fresh);

/// Listens for so long, with the drive at standstill and the brake released.
sequences::Waited listen_at_rest(sequences::BenchLoop& loop, double duration_s,
                                 std::vector<SensorAtRest>& sensors);

}  // namespace rvbench::bench
