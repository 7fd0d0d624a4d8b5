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
  bool resampled = false;  ///< a stamp is more than a hundredth of a step off where it is due
  double worst_gap_s = 0;  ///< longest time between two stamps
};

/// How stamps become uniform samples.
/// @param time_s  stamps; must rise
/// @param rate_Hz  wanted, above 0; NaN: that of the stamps, by their median step
/// @return why not, where they do not rise or leave gaps of more than ten samples
/// Shape   N >= 2 stamps → one answer. Errors  none thrown. Source  ours
std::variant<UniformTime, std::string> uniform_time(const Eigen::VectorXd& time_s, double rate_Hz);

/// Values at the uniform times, on straight lines between the stamps.
/// Shape   N stamps, N values, as uniform_time() has passed them → time.samples values
/// Units   those of the values. Errors  none thrown
/// Limits  between stamps that are h apart it is off by up to (2π·f·h)²/8 of an amplitude at f
/// Source  definition
Eigen::VectorXd resampled(const Eigen::VectorXd& time_s, const Eigen::VectorXd& values,
                          const UniformTime& time);

}  // namespace rvbench::bench
