#include "sim/robot/robot_motion.hpp"

namespace rvbench::sim {
namespace {

constexpr Eigen::Index path(int joint, char direction) { return 3 * (joint - 1) + direction - 'X'; }

constexpr std::array<RobotMotionCard, 3> cards{{
    {"straight slow",
     {7.3, 18, 11, 29.5, 26.5, 52},
     {path(3, 'X'), path(5, 'Y'), path(3, 'X')},
     0.2},
    {"five-axis slow",
     {8.1, 16.4, 13.7, 24.6, 26.0, 47},
     {path(3, 'X'), path(5, 'Y'), path(3, 'X')},
     0.2},
    {"straight fast",
     {9.0, 33.7, 22.3, 17.3, 28.2, 68},
     {path(3, 'Z'), path(5, 'Y'), path(4, 'X')},
     0.4},
}};

}  // namespace

const RobotMotionCard& card_of(RobotMotion motion) {
  return cards[static_cast<std::size_t>(motion)];
}

}  // namespace rvbench::sim
