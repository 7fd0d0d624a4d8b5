#pragma once

#include <cstdint>
#include <random>

namespace rvbench::sim {

/// Blows of a spall on the inner race of a rolling bearing.
///
///     balls pass the spall at BPFI = n/2·(1 + d/D·cos β) per turn of the inner race, times
///     (1 + slip), with 1 % scatter from blow to blow; each blow is half a sine of `duration_s`
///     as strong as the load in the spall's place: (1 + cos ϑ)/2 over the turning race angle ϑ
///
/// Leaves out: the double blow of entry and exit, cage dynamics.
/// Source: McFadden & Smith, J. Sound Vib. 96(1), 69-82 (1984)
class SpalledRace {
 public:
  /// The maker does not publish the crank's bearing: its geometry is assumed, and the kinematics
  /// file of the RV-20E states the same.
  struct Params {
    int rolling_elements = 11;
    double ball_diameter_mm = 5;
    double pitch_diameter_mm = 26;
    double slip = 0;             ///< relative
    double blow_N_per_N = 0;     ///< peak force per N of bearing load
    double duration_s = 0.3e-3;  ///< assumed: excites the housing up to some kHz
  };

  SpalledRace(const Params& p, std::uint64_t seed);

  /// @param race_rad  angle of the inner race against the outer, unwrapped or wrapped per turn
  /// @param load_N    radial load of the bearing
  double force_N(double race_rad, double load_N, double dt_s);

 private:
  Params p_;
  double passes_per_turn_;
  double last_race_rad_ = 0;
  double until_blow_ = 1;  ///< in ball passes
  double since_blow_s_ = 1;
  double strength_N_ = 0;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace rvbench::sim
