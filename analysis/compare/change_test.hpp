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
/// Shape   means of values_a and values_b values, 1 or more each → one test
/// Units   dB; p without
/// Limits  scatter needs freedom; without any scatter p is 0 or 1
/// Errors  none thrown
/// Source  Student, Biometrika 6(1), 1-25 (1908); for a least difference: Hodges & Lehmann, J. R.
///         Stat. Soc. B 16(2), 261-268 (1954)
ChangeTest test_change(double change_dB, double values_a, double values_b, const Scatter& scatter,
                       double least_dB);

/// Half of the interval [dB] that holds the change in 95 of 100 cases.
/// Errors  none thrown. Source  Student (1908), by t_of_p_value()
double half_width(const ChangeTest& test);

/// The change [dB] that such a test finds in nine of ten cases, if it calls p-values up to `p`;
/// infinite where the scatter has no freedom.
/// Errors  none thrown. Source  Student (1908); nine of ten are ours
double detectable_change(const ChangeTest& test, double least_dB, double p);

}  // namespace rvbench::analysis
