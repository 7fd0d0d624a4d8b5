#pragma once

#include <cstdint>
#include <string_view>

#include "sim/draw.hpp"

namespace rvbench::sim {

/// Which robot is simulated and how it is measured. One seed gives one robot, its forces and its
/// records, on any number of threads.
struct RobotOptions {
  std::uint64_t seed = 1;
  double rate_Hz = 4960;
  double stiffness_spread = 0.1;  ///< of each stiffness, uniform, each way
  bool joint3_replaced = false;   ///< its reducer: what its fault adds to the forces is gone

  double record_s = 20;        ///< of each motion
  double sensor_noise = 0.01;  ///< of a channel's RMS, white

  int hits = 5;                 ///< for each path
  double hit_s = 2;             ///< length of the record of one hit
  double hit_scatter = 0.05;    ///< of a hit's strength, direction and place; see hammer_test.hpp
  double hit_noise = 0.01;      ///< of the RMS that a channel has at a nominal hit, white
  double bad_hit_share = 0.15;  ///< how likely a hit goes wrong
  double force_range_N = 444;   ///< beyond, the hammer's signal is clipped (PCB 086C01)
  double acceleration_range_m_s2 = 490;  ///< beyond, a sensor's signal is clipped (PCB 356A16)

  unsigned threads = 0;  ///< 0: as many as there are cores free
};

/// @throws std::invalid_argument naming the option that makes no sense
void require_sound(const RobotOptions& options);

/// Draws for one purpose that do not change with what is drawn for others.
Draw draw_for(const RobotOptions& options, std::string_view purpose);

}  // namespace rvbench::sim
