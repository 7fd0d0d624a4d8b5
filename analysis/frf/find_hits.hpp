#pragma once

#include <vector>

#include "analysis/frf/frf_record.hpp"

namespace rvbench::analysis {

/// How a long record is cut into hits.
struct HitSearch {
  double before_s = 0.01;    ///< kept before the force rises, >= 0
  double length_s = 1;       ///< of each hit's record, > before_s
  double least_share = 0.1;  ///< of the strongest pulse, in (0, 1): what is below is no hit
};

/// One record for each hit in a long one. A pulse within the length of the hit before it does not
/// begin a record of its own: there it shows as a double hit. What begins too late to be a whole
/// record is left out, as is what is no higher than eight times the force's noise.
///
/// Shape   each: all channels, length_s·rate samples; in order of time; none if there is no hit
/// Units   of the record
/// Errors  throws std::invalid_argument: the search out of range, not one excitation, a force that
///         is not finite, fewer than 16 samples
/// Source  ours
std::vector<FrfRecord> find_hits(const FrfRecord& record, const HitSearch& search);

}  // namespace rvbench::analysis
