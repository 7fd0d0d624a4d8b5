#pragma once

#include <vector>

namespace rvbench::analysis {

struct ConfidenceInterval {
  double low = 0, high = 0;
};

/// A mean square of an analysis of variance, and how often it enters a sum.
struct MeanSquareTerm {
  double coefficient = 0;  ///< of either sign
  double mean_square = 0;
  double freedom = 0;  ///< degrees of freedom, > 0
};

/// Interval of a sum of expected mean squares, such as a variance component; its ends may be below
/// 0. For one term it is the exact one of chi-square.
///
///     L = Σc·M - √(ΣG²c²M² + ΣH²c²M² + ΣΣG_qr·c_q·|c_r|·M_q·M_r)     G of terms that add, H of
///     U = Σc·M + √(ΣH²c²M² + ΣG²c²M² + ΣΣH_qr·c_q·|c_r|·M_q·M_r)     those that take away, and so
///     on
///
/// Limits   modified large-sample: exact for one term, near to the confidence else. Products of
///          terms of like sign are left out
/// Errors   throws std::invalid_argument: no term, confidence not within (0, 1)
/// Source   Graybill & Wang, J. Am. Stat. Assoc. 75(372), 869-873 (1980); with differences: Ting,
///          Burdick, Graybill, Jeyaratnam & Lu, J. Stat. Comput. Simul. 35, 135-143 (1990)
ConfidenceInterval mls_interval(const std::vector<MeanSquareTerm>& terms, double confidence);

}  // namespace rvbench::analysis
