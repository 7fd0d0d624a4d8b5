#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Other signatures that explain what was found as well as the one that it was given to:
/// their comb holds every line that carries the evidence, their own first line is among these, and
/// no line of theirs is stretched beyond slip or tolerance. Two equal bearings on one shaft are the
/// plainest case.
///
/// @param score       of the finding, from one record
/// @param resolution  orders per line of that record: what lies closer than 0.75 of it is one line
/// @return indices into kinematics.signatures; empty where the finding stands alone
/// Units   orders
/// Errors  throws std::invalid_argument: the score is of no signature of the kinematics
/// Source  ours
std::vector<std::size_t> equal_explanations(const SignatureScore& score,
                                            const Kinematics& kinematics, double resolution);

}  // namespace rvbench::analysis
