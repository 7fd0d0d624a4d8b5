#pragma once

#include <cstddef>

namespace rvbench::analysis {

/// What a limit is to keep to: it leaves at least this share of all good units within, and of many
/// limits that are learnt so, this share does.
struct Coverage {
  double content = 0.999;
  double confidence = 0.95;
};

/// The k for which mean + k·s of n units is a limit of that coverage, if units are normal:
///
///     P(x̄ + k·s >= μ + z·σ) = confidence,   z the content's quantile
///
/// k·√n is the quantile of Student's noncentral t, of n - 1 degrees of freedom and noncentrality
/// z·√n; here the integral over the distribution of s is solved for k.
///
/// @param units     n, 2 or more
/// @throws std::invalid_argument if there are fewer, or content or confidence are not within (0, 1)
/// Source  Owen, Sandia Monograph SCR-607 (1963); Krishnamoorthy & Mathew, Statistical Tolerance
///         Regions (2009), sec. 2.2
double one_sided_tolerance_factor(std::size_t units, const Coverage& coverage);

/// The k for which mean ± k·s leaves the content between both, exactly as well:
///
///     E[ P(χ² > (n - 1)·r(x̄)²/k²) ] = confidence,   Φ(x̄ + r) - Φ(x̄ - r) = content
///
/// Errors  of one_sided_tolerance_factor()
/// Source  Krishnamoorthy & Mathew (2009), sec. 2.3.1
double two_sided_tolerance_factor(std::size_t units, const Coverage& coverage);

}  // namespace rvbench::analysis
