#pragma once

#include <Eigen/Core>
#include <optional>

namespace rvbench::hal::formats {

inline constexpr double least_step = 1e-100;  ///< so that a rate is finite

/// The step of times or frequencies that rise evenly; nothing if they do not, or are fewer than
/// two.
///
/// A value may be off by 1 % of a step and by the rounding of one printed with six digits, by 30 %
/// of a step together: one lost sample moves some value by half a step at the least.
std::optional<double> even_step(const Eigen::VectorXd& x);

}  // namespace rvbench::hal::formats
