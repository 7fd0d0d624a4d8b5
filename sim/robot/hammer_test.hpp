#pragma once

#include <vector>

#include "hal/types/recording.hpp"
#include "sim/robot/hit_plan.hpp"
#include "sim/robot/virtual_robot.hpp"

namespace rvbench::sim {

struct HammerTest {
  /// One a hit. Channel 0 is the hammer, N, named by the place that was to be hit; then the 42
  /// sensors, m/s². `repeat` counts the hits of a place.
  std::vector<Recording> hits;
  std::vector<HitPlan> truth;  ///< one a hit; only a test may know it
};

/// Hits each path as often as the options say and records force and accelerations, with 50 ms
/// before the hit. Raw: bad hits are among them and nothing tells which.
///
/// Exact: spectra are products of FRF and pulse and are brought back to time on a line to the right
/// of the frequency axis, so that what rings beyond the record does not come in again (to 1e-6).
/// All channels pass the same low-pass of linear phase, 0.7 to 1 of half the sample rate.
/// Noise: white, of the RMS that the channel would have at a hit of nominal strength.
/// Source  Wilcox, Int. J. Elect. Eng. Educ. 15(3), 247-265 (1978): numerical Laplace inversion
HammerTest hammer_test(const VirtualRobot& robot);

}  // namespace rvbench::sim
