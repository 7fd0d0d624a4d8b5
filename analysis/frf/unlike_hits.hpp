#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/frf/frf_record.hpp"

namespace rvbench::analysis {

/// How far the responses that each hit at a place measured are from those of the others: what
/// a hammer that leant over or missed the place does, and nothing in its own record tells.
///
///     d(i, j)² = Σ|Yᵢ·Xⱼ - Yⱼ·Xᵢ|² / Σ|Yᵢ·Xⱼ|·|Yⱼ·Xᵢ|     over responses and lines
///
/// and of a hit the lower median over the others, so that three good ones of five find two bad
/// ones. Lines at which the hammer has no force count nothing. A hit θ off, towards a direction in
/// which the structure answers alike, lies at 2·sin(θ/2); two hits that differ by 5 % at 0.05.
///
/// @param hits  in their windows, of the same rate, length and channels
/// Shape   one per hit; zeros for fewer than three, of which none can be told to be the odd one
/// Units   none
/// Errors  throws std::invalid_argument: not one excitation, shapes that differ
/// Limits  bad hits that are half of all or more
/// Source  ours
Eigen::VectorXd distances_to_others(const std::vector<FrfRecord>& hits);

}  // namespace rvbench::analysis
