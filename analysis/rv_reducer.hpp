#pragma once

#include <string>
#include <vector>

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

/// Signatures of a bearing whose inner race turns at `race_order` against the outer one.
/// Shape   inner race, outer race, rolling element, cage
/// Units   orders of the input shaft; slip relative
/// Errors  throws std::invalid_argument of bearing_orders()
/// Source  Randall & Antoni, Mech. Syst. Signal Process. 25(2), 485-520 (2011), for the sidebands
std::vector<Signature> bearing_signatures(const BearingGeometry& bearing, double race_order,
                                          double slip);

/// The bearing whose signatures, in the order of bearing_signatures(), begin at `first`.
RollingBearing rolling_bearing(const std::string& name, const BearingGeometry& bearing,
                               double race_order, std::size_t first);

}  // namespace rvbench::analysis
