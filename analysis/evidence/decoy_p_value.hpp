#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Probability that noise gives a comb this log-likelihood ratio or more, judged by its decoys: the
/// same sum where no part has lines, so that what noise the IMFs and channels share counts as it
/// does in the sum.
///
/// Sums of exponential numbers are nearly Gaussian under the cube root. Centre and spread are the
/// decoys' median and its median deviation, which a few decoys on a line of something else do not
/// move; the tail is Student's, as the spread is an estimate. Neither is believed to be below that
/// of as many independent lines. The centre is as uncertain as the lines that all decoys are made
/// of leave it: its variance is to the sum's as the lines of a sum to theirs.
///
/// Shape   log_ratio: one sum; decoys: at least 2 sums of as many lines
/// @param lines_per_decoy_line  lines of a sum over different lines in all decoys; 0: endless
/// Units   dimensionless
/// @return in (0, 1]; 1 where the decoys have no line
/// Errors  throws std::invalid_argument: fewer than 2 decoys
/// Source  Wilson & Hilferty, Proc. Natl. Acad. Sci. 17(12), 684-688 (1931): cube root; Rousseeuw &
///         Croux, J. Am. Stat. Assoc. 88, 1273-1283 (1993): 37 % efficiency of the median deviation
double decoy_p_value(double log_ratio, const Eigen::Ref<const Eigen::VectorXd>& decoys,
                     double lines_per_decoy_line = 0);

}  // namespace rvbench::analysis
