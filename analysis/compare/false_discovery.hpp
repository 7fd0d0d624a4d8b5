#pragma once

#include <vector>

namespace rvbench::analysis {

/// p-values that have paid for all that was asked: calling those up to q keeps the expected share
/// of false calls at q or less, and where nothing is true the probability of any call.
///
///     p̃₍ᵢ₎ = min over j >= i of (m / j)·p₍ⱼ₎
///
/// NaN stays NaN and is not counted.
///
/// Shape   one for each, in their order. Errors  none thrown
/// Limits  tests independent, or positively dependent as those of neighbouring sensors are
/// Source  Benjamini & Hochberg, J. R. Stat. Soc. B 57(1), 289-300 (1995); dependence: Benjamini &
///         Yekutieli, Ann. Stat. 29(4), 1165-1188 (2001)
std::vector<double> adjusted_p_values(const std::vector<double>& p_values);

}  // namespace rvbench::analysis
