#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "sim/robot/robot_arm.hpp"

namespace rvbench::sim {

/// The article's three motions, each at constant speed.
enum class RobotMotion { straight_slow, five_axis_slow, straight_fast };

inline constexpr std::array<RobotMotion, 3> robot_motions{
    RobotMotion::straight_slow, RobotMotion::five_axis_slow, RobotMotion::straight_fast};

struct RobotMotionCard {
  std::string_view name;                      ///< "straight slow"
  std::array<double, robot_joints> shaft_Hz;  ///< input shaft of each joint's reducer
  std::array<Eigen::Index, 3> leaders;        ///< path that contributes most to target X, Y, Z
  double level_m_s2 = 0;                      ///< RMS of what the leader contributes to X
};

/// Shafts   of joint 3 at 11, 13.7 and 22.3 Hz and of joint 2 at 18 Hz: the lines of the article's
///          Fig. 11; 9 Hz is what remains in Fig. 18. The other shafts' speeds are assumed.
/// Leaders  the article's Figs. 5-7: J3 X, J5 Y, J3 X (both slow motions); J3 Z, J5 Y, J4 X (fast)
/// Level    assumed, so that peaks at the flange come near the article's 0.9 g
const RobotMotionCard& card_of(RobotMotion motion);

}  // namespace rvbench::sim
