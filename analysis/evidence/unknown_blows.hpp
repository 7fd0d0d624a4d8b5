#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/blow_lines.hpp"
#include "analysis/evidence/residual_envelope.hpp"

namespace rvbench::analysis {

/// Families of blows in one record that no bearing of the machine explains, by the spacing whose
/// harmonics stand out among all spacings.
/// Shape   lines: without what the bearings explain; scores: of all signatures, judged before
std::vector<UnknownFamily> unknown_blows(const BlowLines& lines,
                                         const std::vector<ResidualEnvelope>& channels,
                                         const Kinematics& kinematics,
                                         const std::vector<SignatureScore>& scores);

}  // namespace rvbench::analysis
