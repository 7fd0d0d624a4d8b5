#pragma once

#include <vector>

#include "analysis/frf/frf_band.hpp"
#include "analysis/frf/frf_record.hpp"

namespace rvbench::analysis {

/// How far each hit at a place is from the H1 average of all of them, as it counts there:
///
///     δ = (y·x* - H1·|x|²) / mean |x|²       they sum to 0
///
/// Hits drawn anew, n with replacement, have the average H1 + Σ δ / n. Place, direction and
/// strength of a blow change all responses together: that is why whole hits are drawn.
///
/// @param hits  in their windows, one excitation each
/// Shape   one per hit: responses x lines of the band
/// Units   of the responses per that of the excitation
/// Errors  throws std::invalid_argument: no hit, hits that differ in length or channels, a band
///         that reaches beyond the lines or holds none. A line without force is 0
/// Source  Davison & Hinkley, Bootstrap Methods and their Application (1997), sec. 2.7: the
///         infinitesimal jackknife of a ratio
std::vector<Eigen::MatrixXcf> hit_deviations(const std::vector<FrfRecord>& hits,
                                             const FrfBand& band);

}  // namespace rvbench::analysis
