#pragma once

#include <string>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// Characteristic orders and signatures of an RV reducer, all of them multiples of one turn of the
/// carrier, or of several turns where i is not whole: its numerator is the period in input turns.
/// Housing fixed, carrier is the output; signs are dropped.
///
///     i = 1 + (z2/z1)·zp;   sun against carrier (i − 1)/i;   crank against carrier zp/i;
///     crank in the housing zc/i;   sun-planet mesh z1·(i − 1)/i;   pin-lobe pass zp·zc/i
///
/// Shape, units  as Kinematics has them; orders of the input shaft
/// Source  Willis' equation of planetary gears; names as in the article's Table 4; limits are
/// assumed
/// @param crank_bearing  of each crank, inner race on the crank; rolling_elements 0: not known
/// @throws std::invalid_argument naming what is not positive, or pins != lobes + 1
Kinematics rv_reducer(const std::string& machine, const RvGeometry& geometry,
                      const BearingGeometry& crank_bearing);

}  // namespace rvbench::analysis
