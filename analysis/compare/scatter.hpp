#pragma once

#include <vector>

namespace rvbench::analysis {

/// Variance of one value of a group, and the degrees of freedom it was estimated with.
struct Scatter {
  double variance = 0;
  double freedom = 0;
};

/// Pooled over both groups; of no freedom if neither has two values.
/// Shape   any number in each. Units  those of the values, squared. Errors  none thrown
/// Source  Student, Biometrika 6(1), 1-25 (1908): the sums of squares over their freedom
Scatter pooled_scatter(const std::vector<double>& a, const std::vector<double>& b);

/// Estimates of one kind, each drawn towards what all of them say: their true variances are taken
/// as scaled inverse chi-square, whose scale s₀² and freedom d₀ are fitted to their logarithms.
///
///     s² → (d₀·s₀² + d·s²) / (d₀ + d),   with d₀ + d degrees of freedom
///
/// Where the estimates differ by no more than chance d₀ is large, where they are of many kinds it
/// is next to 0 and each stays itself. d₀ is taken as low as they allow, two standard errors of the
/// variance of the logarithms down: a dozen estimates look like one by chance though their true
/// variances are four times apart, and changes of the larger ones would be called too often.
///
/// Shape   one for each, in their order. Units  one, for all. Errors  none thrown
/// Limits  an estimate of more freedom than d₀ stays itself: where they are of so many kinds they
///         need not be of this distribution, and p-values of the larger ones would be too small.
///         Fewer than 10 that are above 0 and have freedom: all stay as they are. A sum is never
///         worth more freedom than all estimates have together
/// Source  Smyth, Stat. Appl. Genet. Mol. Biol. 3(1), article 3 (2004), section 6.2; the lowest d₀
///         is ours
std::vector<Scatter> drawn_together(std::vector<Scatter> estimates);

}  // namespace rvbench::analysis
