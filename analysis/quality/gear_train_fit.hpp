#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// How well the orders of a gear train fit the lines of records, as these were read, and as they
/// would be at other speeds.
struct GearTrainFit {
  double share = 0;   ///< of the power of all lines but the input shaft's own; mean over channels
  double chance = 1;  ///< share of other speeds at which the same lines fit as well, by their power
                      ///< or with the loudest evened, whichever is less
  double best_speed = not_known;  ///< where they fit so much better that it stands out from all
                                  ///< others: relative to the speed that was used; NaN: nowhere
  double best_share = not_known;

  /// Whether the machine is this one, at this speed and rate: no other speed does as well.
  bool is_shown() const { return chance == 0; }
};

/// Whether the machine has lines of its own: any that turns has those of its input shaft, and what
/// slips fits many.
/// Errors  none thrown. Source  ours
bool has_own_lines(const Kinematics& kinematics);

/// Fits the gear train to the lines of all points. Harmonics of the input shaft are left out, but
/// for those that are a mesh's: whatever turns has them. The same orders at speeds 0.1 to 5 % off
/// are gear trains that are not there: what they explain is what chance, and the density of the
/// orders, explain. With 394 of them, and two ways to count, about one record in 200 of another
/// machine passes.
///
/// Shape    any number of points; no line at all: share 0, chance 1
/// Units    orders of the input shaft; shares of power
/// Errors   none thrown
/// Source   ours: a permutation test, with the speed for what is permuted
GearTrainFit gear_train_fit(const std::vector<Examination>& points, const Kinematics& kinematics);

}  // namespace rvbench::analysis
