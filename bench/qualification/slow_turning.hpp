#pragma once

#include <optional>

#include "bench/qualification/self_test_spec.hpp"
#include "sequences/bench_loop.hpp"

namespace rvbench::bench {

/// What the devices tell while the shaft turns slowly, each a mean over a stretch of time.
struct SlowTurning {
  double angle_rpm = not_known;  ///< by the transducer's angle
  double drive_rpm = not_known;  ///< as the drive tells it
  double brake_Nm = not_known;   ///< as the brake tells it, at the output
  double torque_Nm = not_known;  ///< of the transducer, at the input
};

/// Turns at the self-test's speed with that load and, once it had time to get there, takes means.
/// The shaft goes on to turn.
/// @return how the self-test must end, if it cannot go on
std::optional<Ending> turn_slowly(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                                  double brake_torque_Nm, SlowTurning& seen);

/// How long the above takes.
double slow_turning_s();

/// Stops the drive with that load on and, at standstill, lets the brake go.
/// `Waited::met`: standstill was seen.
sequences::Waited come_to_rest(sequences::BenchLoop& loop, double brake_torque_Nm);

}  // namespace rvbench::bench
