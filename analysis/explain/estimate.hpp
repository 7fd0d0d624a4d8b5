#pragma once

#include <string>
#include <vector>

#include "analysis/explain/fit.hpp"

namespace rvbench::analysis {

/// A number found by a fit, with the interval that holds it nine times in ten.
struct Estimate {
  std::string name, unit;
  double value = 0, low = 0, high = 0;
};

/// Of all values of a fit: of the base, then of each effect; waves as size and phase.
/// Shape, units  one per value, in its unit, a phase in rad. Errors  none thrown: the fit has a
///         covariance
/// Source  normal intervals, 1.645 standard errors of Liang & Zeger (1986) to each side
std::vector<Estimate> estimates(const ForwardModel& model, const Fit& fit);

}  // namespace rvbench::analysis
