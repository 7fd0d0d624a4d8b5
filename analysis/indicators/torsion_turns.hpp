#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::analysis {

/// Where a torsion turns round, and the torque that it took.
struct TorsionTurn {
  Eigen::Index at = 0;  ///< the sample with the extreme of the torsion, the first of equals
  double peak_Nm = 0;
};

/// From one turn to the next, both included.
struct TorsionBranch {
  TorsionTurn from, to;
  Eigen::Index size() const { return to.at - from.at + 1; }
};

/// The extremes of torsion and torque between the torque's passages from beyond light_Nm on one
/// side to beyond it on the other. One at the end that has less than half the peak of the one
/// before is left out: the record ends on its way.
///
/// Shape   N samples of each → any number of turns, in their order, the sign of their peaks in turn
/// Units   N·m, any unit of angle
/// Errors  none thrown. @pre as many torques as torsions
/// Source  ours
std::vector<TorsionTurn> torsion_turns(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm,
                                       const Eigen::Ref<const Eigen::VectorXd>& torsion_rad,
                                       double light_Nm);

}  // namespace rvbench::analysis
