#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// How well the orders of a gear train fit the lines of records, as these were read, and as they
/// would be at other speeds.
struct GearTrainFit {
  double share = 0;  ///< of the power of all lines but the input shaft's own; mean over channels
  int tried = 0;     ///< other speeds; 0 where there are no such lines
  int as_good = 0;  ///< of these the same lines fit as well at so many, by their power and with the
                    ///< loudest evened together
  bool is_too_short = false;      ///< the records: at all other speeds the lines would fit as well
  bool fits_a_ratio = false;      ///< they fit as well at a speed that is off by a ratio of small
                                  ///< numbers, the best one
  double best_speed = not_known;  ///< where they fit so much better that it stands out from all
                                  ///< others: relative to the speed that was used; NaN: nowhere
  double best_share = not_known;

  /// Whether the machine is this one, at this speed and rate: one other speed at most does as well.
  bool is_shown() const { return tried > 0 && as_good <= 1 && !fits_a_ratio; }
};

/// Whether the machine has lines of its own: any that turns has those of its input shaft, and what
/// slips fits many.
/// Errors  none thrown. Source  ours
bool has_own_lines(const Kinematics& kinematics);

/// Fits the gear train to the lines of all points. Harmonics of the input shaft are left out, but
/// for those that are a mesh's and stand out from the others: whatever turns has them. The same
/// orders at speeds 0.1 to 5 % off, or as much more as the records need to part them, are gear
/// trains that are not there: what they explain is what chance, and the density of the orders,
/// explain. There are 394 of them: of records with lines anywhere about one in 200 passes. Speeds
/// that are off by 3/2, 2, 3, 4, 5 and 10, as rates and poles may be mistaken, must not
/// explain as much; lower ones not more by half, for there harmonics of a mesh lie on higher ones.
///
/// Shape    any number of points; no line beside the input shaft's: share 0, none tried
/// Units    orders of the input shaft; shares of power
/// Limits   a machine that shares the mesh that is heard, pinion and shaft, is taken for this one
/// Errors   none thrown
/// Source   ours: a permutation test, with the speed for what is permuted
GearTrainFit gear_train_fit(const std::vector<Examination>& points, const Kinematics& kinematics);

}  // namespace rvbench::analysis
