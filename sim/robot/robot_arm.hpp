#pragma once

#include <array>

#include "sim/draw.hpp"
#include "sim/robot/structure.hpp"

namespace rvbench::sim {

inline constexpr int robot_joints = 6;

/// A six-axis arm for 12 kg, standing still with the forearm level.
///
/// X forward, Z up, Y to the left by the right-hand rule, from the middle of the foot. Each joint's
/// motor with the reducer's input gear is a body of its own on a soft mount: that is the joint's
/// active side, where forces act and the hammer hits. What carries the mount is its passive side.
/// Joints 1-4 have RV reducers, 5 and 6 harmonic drives, which are softer.
///
/// Assumed, as no drawing is published: all masses, places and stiffnesses. They are of the size
/// that arms of 12 kg payload, 1.5 m reach and 190 kg have; they put the first modes of the whole
/// arm between 8 and 25 Hz and the mounts near 105-150 Hz, those of the heavy joints 1 and 2
/// at 230 and 260 Hz.
/// Leaves out: bending of the links themselves, that modes change with the pose
struct RobotArm {
  Structure structure;
  std::array<BodyPoint, robot_joints> active;
  std::array<BodyPoint, robot_joints> passive;
  BodyPoint flange;   ///< where the targets are
  BodyPoint forearm;  ///< of three sensors that no analysis is fitted to
};

/// One specimen: each stiffness off by up to `spread` of itself, each loss factor by up to 5 %.
/// @param spread  0 to 0.3
/// @throws std::invalid_argument if spread is out of range
RobotArm make_robot_arm(Draw draw, double spread);

}  // namespace rvbench::sim
