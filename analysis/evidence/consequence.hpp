#pragma once

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Whether what one part shows may come of another, graver one: a cracked tooth that loads its
/// shaft once per turn makes the shaft's lines, too. Each line that carries the lesser must lie on
/// the graver's comb, which here begins with what modulates it, the sidebands' spacing itself, and
/// the harmonics that are searched for nobody's sake since sound machines have them as well.
///
/// @param lesser, graver  scores of one record
/// @param resolution      orders per line of that record: within 0.75 of it lines are the same
/// Units   orders of the input shaft
/// Errors  throws std::invalid_argument: a score is of no signature of the kinematics
/// Source  ours
bool may_follow_from(const SignatureScore& lesser, const SignatureScore& graver,
                     const Kinematics& kinematics, double resolution);

}  // namespace rvbench::analysis
