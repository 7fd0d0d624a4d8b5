#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Families of lines that follow the shaft as damage does, and that no part of the machine makes:
/// blows that most of the points show, and families of d.unexplained that modulate a mesh.
///
/// @param d  with its hypotheses and d.unexplained
/// Units   orders of the input shaft
/// Source  ours
std::vector<UnknownFamily> unknown_families(const std::vector<Examination>& points,
                                            const Diagnosis& d, const Kinematics& kinematics);

}  // namespace rvbench::analysis
