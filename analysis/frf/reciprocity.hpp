#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/frf/driving_point.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// How alike two responses are that Maxwell's theorem says are equal.
struct Reciprocity {
  Eigen::VectorXd score;  ///< per line of the band, -1 to 1; 0 where both are 0 or not finite
  double band_score = 0;  ///< of all lines together
};

/// Per line 2·Re(a·b*)/(|a|² + |b|²); of the band the same of sums. 1: equal, -1: equal but for the
/// sign, 0: nothing in common, or out of phase by a right angle; 0.8: twice as large.
///
/// Shape   lines of the band that both have
/// Units   both of the same
/// Errors  throws std::invalid_argument: they differ in first line, step or number of lines
/// Source  Maxwell's reciprocal theorem: Ewins, Modal Testing (2nd ed., 2000), sec. 2.2; the score:
/// ours
Reciprocity reciprocity(const FrequencyResponse& a, const FrequencyResponse& b,
                        const FrfBand& band);

/// Two responses of a set, of which one has the other's places the other way round.
struct ReciprocalPair {
  std::size_t first = 0, second = 0;  ///< where they are in the set
  double sense = 1;                   ///< -1 where directions of one axis were stated opposite
  Reciprocity reciprocity;            ///< with the sense taken into account
};

/// All of a set, each once; directions that differ in sign alone are the same axis.
/// Shape, units, errors, source  of reciprocity()
std::vector<ReciprocalPair> reciprocal_pairs(const std::vector<FrequencyResponse>& responses,
                                             const FrfBand& band);

}  // namespace rvbench::analysis
