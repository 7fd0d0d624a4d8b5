#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>

namespace rvbench::bench {

/// What uniform sampling makes of time stamps.
struct UniformTime {
  double rate_Hz = 0;
  double start_s = 0;
  Eigen::Index samples = 0;
  bool resampled = false;  ///< the stamps were not uniform
  double worst_gap_s = 0;  ///< longest time between two stamps
};

/// @param time_s  stamps; must rise
/// @param rate_Hz  wanted; NaN: that of the stamps, by their median step
/// @return why not, where they do not rise or leave gaps of more than ten samples
std::variant<UniformTime, std::string> uniform_time(const Eigen::VectorXd& time_s, double rate_Hz);

/// Values at the uniform times, on straight lines between the stamps.
Eigen::VectorXd resampled(const Eigen::VectorXd& time_s, const Eigen::VectorXd& values,
                          const UniformTime& time);

}  // namespace rvbench::bench
