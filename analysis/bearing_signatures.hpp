#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

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
