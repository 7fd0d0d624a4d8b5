#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "analysis/station/control_chart.hpp"

namespace rvbench::analysis {

/// How an exponentially weighted mean forgets, and how far it may go. These two make one false
/// alarm in about 500 points, and find a shift of one σ after 10 on average.
/// Source  Lucas & Saccucci, Technometrics 32(1), 1-12 (1990)
struct EwmaSettings {
  double weight = 0.2;   ///< λ of the newest value, in (0, 1]
  double width = 2.962;  ///< L: limits in standard deviations of the mean, > 0
};

struct EwmaChart {
  Eigen::VectorXd means;          ///< z_i
  Eigen::VectorXd lower, upper;   ///< at each point
  std::vector<Eigen::Index> out;  ///< points beyond them
};

/// Small shifts that last, which individuals do not show:
///
///     z_i = λ·x_i + (1 - λ)·z_(i-1),  z_0 the centre
///     limits  centre ± L·σ·√(λ/(2 - λ)·(1 - (1 - λ)^(2i)))
///
/// exact from the first point on, not those of a chart that has run for long.
///
/// Shape   N values → N points. Units  of the values
/// @return why there is none otherwise: a mean or a limit is no finite number
/// Errors  throws std::invalid_argument: no values, one not finite, no σ, settings out of range
/// Source  Roberts, Technometrics 1(3), 239-250 (1959); NIST/SEMATECH e-Handbook, sec. 6.3.2.4
std::variant<EwmaChart, std::string> ewma_of(const Eigen::Ref<const Eigen::VectorXd>& values,
                                             const ChartBaseline& baseline,
                                             const EwmaSettings& settings = {});

}  // namespace rvbench::analysis
