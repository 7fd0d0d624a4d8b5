#pragma once

#include <limits>
#include <string>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// Orders that belong together by what makes them.
struct OrderBand {
  std::string name;
  double from = 0;
  double to = std::numeric_limits<double>::infinity();  ///< as far as the record reaches
};

/// Bands of a machine, side by side from order 0 on: what is slower than its meshes, each mesh with
/// three sidebands of the input shaft (half-way to the next mesh where there is one), and what is
/// faster: harmonics and resonances. A machine without meshes has two: its characteristic orders
/// with four harmonics, and what they strike above.
///
/// Shape   m meshes of different orders → m + 2, or 2; none for a machine without orders
/// Units   orders of the input shaft
/// Errors  none thrown
/// Source  ours; as many sidebands as sideband_ratio() counts, and harmonics as the signatures of
///         bearings
std::vector<OrderBand> order_bands(const Kinematics& kinematics);

}  // namespace rvbench::analysis
