#pragma once

#include <string>

#include "analysis/indicators/gear_condition.hpp"

namespace rvbench::analysis {

/// What the average turn of one gear has beside its mesh, to be held against later records.
struct GearResidual {
  std::string of;  ///< "sun-planet mesh, sun against carrier"
  ResidualMoments moments;
};

}  // namespace rvbench::analysis
