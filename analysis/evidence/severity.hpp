#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// How bad a part is, over the points that show it.
struct Severity {
  double depth = 0;  ///< modulation depth, median over the points
  double low = 0;    ///< 95 % interval of it, by the scatter between points; of a single point
  double high = 0;   ///< by its noise
};

/// Median depth with its interval: points drawn anew with replacement; a single one moved by its
/// noise.
///
/// Shape   at least one score
/// Units   modulation depth, 1 = fully modulated
/// Limits  of a single point the interval tells its noise, not how units or mountings scatter; of
///         fewer than six it is their range at most, which holds the median less often than 95 %
/// Errors  throws std::invalid_argument if there is no score; the same scores give the same answer
/// Source  Efron & Tibshirani, An Introduction to the Bootstrap (1993), ch. 13: percentiles
Severity severity_of(const std::vector<const SignatureScore*>& scores);

}  // namespace rvbench::analysis
