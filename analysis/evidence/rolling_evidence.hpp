#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/residual_envelope.hpp"

namespace rvbench::analysis {

/// Scores the parts of all rolling bearings on the squared envelopes of one record.
///
/// Races and cage of a bearing share one cage speed: with n rolling elements and a cage that makes
/// c turns per turn of the inner race against the outer, the races are struck n·(1 − c) and n·c
/// times. The part that stands out most sets c; the others are judged at it, without the lines that
/// it explains. A rolling element's own spin is free within the slip that its signature allows.
///
///     S = Σ_channels Σ_lines −ln p,   p-value: against the largest S of the same search at orders
///                                      that no part of the bearing has
///
/// Shape   one envelope per channel, of one resolution; one score per signature of the kinematics,
///         those of gears untouched
/// Units   orders of the input shaft; depths: rms of the blows times √2 over that of the gears, or
///         of the whole signal where the machine has no meshes
/// Source  Randall & Antoni, Mech. Syst. Signal Process. 25(2), 485-520 (2011); the tie by the
///         cage speed: Harris, Rolling Bearing Analysis (4th ed., 2001)
///
/// @return families of blows that no bearing of the machine explains
std::vector<UnknownFamily> score_rolling(const std::vector<ResidualEnvelope>& channels,
                                         const Kinematics& kinematics,
                                         std::vector<SignatureScore>& scores);

}  // namespace rvbench::analysis
