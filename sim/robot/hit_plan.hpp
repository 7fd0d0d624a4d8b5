#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/robot/robot_options.hpp"

namespace rvbench::sim {

enum class HitKind { good, double_hit, overload, weak, misdirected };

std::string_view to_string(HitKind kind);

/// What one hit of the hammer will be. A plain half sine; a double hit has a second, weaker one.
///
/// Scatter s   of all hits, normal: 0.7·s of the strength that the force cell tells, 0.4·s rad of
///             the direction about each transverse axis, 30 mm·s of the place along each axis.
///             Together they change a response by about s.
/// Bad         at the share that the options tell, at most every second hit of a path: 200 N in
///             double, with 25-60 % again after 5-25 ms; 600-900 N; 4-10 N; or 35-55° off
struct HitPlan {
  Eigen::Index path = 0;
  int number = 0;  ///< 1, 2, ... of this path
  HitKind kind = HitKind::good;
  double peak_N = 0;          ///< of the half sine
  double width_s = 0;         ///< 0.2-1 ms: the tip's, drawn for the robot, ±10 % a hit
  double start_s = 0;         ///< in the record
  double second_after_s = 0;  ///< 0 if it hits once
  double second_share = 0;    ///< of the first
  double told_share = 1;      ///< of the force, what the hammer's signal tells
  Eigen::Vector3d direction;  ///< of the force, about a unit vector
  Eigen::Vector3d arm_m;      ///< from the point that was aimed at to the one that was hit
  std::uint64_t noise_seed = 0;
};

inline constexpr double nominal_peak_N = 200;
inline constexpr double pre_trigger_s = 0.05;

/// In the order of the paths, hits of a path in a row.
std::vector<HitPlan> plan_hits(const RobotOptions& options);

}  // namespace rvbench::sim
