#pragma once

#include "analysis/station/gage_study.hpp"

namespace rvbench::analysis {

/// Sums of squares, F and p of a crossed, balanced study. Effects are random, so parts and
/// operators are held against their interaction or, where that is pooled, against the error.
///
/// Units   of the readings, squared. Errors  none thrown; F is 0 where nothing is to divide by
/// Source  Montgomery, Design and Analysis of Experiments, two-factor random model
GageAnova anova_of(const GageReadings& readings);

}  // namespace rvbench::analysis
