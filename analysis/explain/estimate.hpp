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
std::vector<Estimate> estimates(const ForwardModel& model, const Fit& fit);

}  // namespace rvbench::analysis
