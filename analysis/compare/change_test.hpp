#pragma once

#include "analysis/compare/scatter.hpp"

namespace rvbench::analysis {

/// Two means of levels, held against each other.
struct ChangeTest {
  double change_dB = 0;
  Scatter scatter;      ///< of one value [dB²]
  double error_dB = 0;  ///< standard error of the change
  double p_value = 1;
};

/// Student's test of two means with one variance, of the hypothesis that they are no more than so
/// much apart:
///
///     t± = (|Δ| ± least) / (s·√(1/n_a + 1/n_b)),   p = P(T > t₋) + P(T > t₊)
///
/// Limits  scatter needs freedom; without any scatter p is 0 or 1
/// Source  Student, Biometrika 6(1), 1-25 (1908); for a least difference: Hodges & Lehmann, J. R.
///         Stat. Soc. B 16(2), 261-268 (1954)
ChangeTest test_change(double change_dB, double values_a, double values_b, const Scatter& scatter,
                       double least_dB);

/// Half of the interval [dB] that holds the change in 95 of 100 cases.
double half_width(const ChangeTest& test);

/// The change [dB] that such a test finds in nine of ten cases, if it calls p-values up to `p`.
double detectable_change(const ChangeTest& test, double least_dB, double p);

}  // namespace rvbench::analysis
