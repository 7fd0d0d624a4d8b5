#pragma once

#include <string>
#include <vector>

#include "analysis/frf/driving_point.hpp"
#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

enum class DirectionDoubtKind {
  reversed_sign,  ///< sensor and hammer at this place have opposite signs
  swapped_axes,   ///< two axes of the sensor (or of the hammer) at this point are exchanged
  not_reciprocal  ///< neither explains it
};

/// What seems wrong with a place, and by what numbers.
struct DirectionDoubt {
  DirectionDoubtKind kind;
  DegreeOfFreedom place;
  std::string other_axis;  ///< of swapped_axes; of the other place otherwise, or empty
  double score = 0;        ///< band score of reciprocity, or the driving point's positive share
  std::string reason;      ///< for people
};

/// Signs and axes that the responses of one structure contradict.
///
/// A driving point that gives power is reversed. A place whose reciprocal pairs are nearly all
/// equal but for the sign is reversed too; where only one pair says so, both of its places are
/// named. Axes of a point are swapped where its responses agree (score above 0.8) with those to the
/// other axis' force and not with those to their own, both ways round. A pair that differs by no
/// more than a lean of 0.1 rad makes of the largest response between its points is not doubted.
///
/// Shape   any number of responses of the same lines; each doubt once
/// Units   responses to reciprocal places in the same unit
/// Errors  throws std::invalid_argument of reciprocity()
/// Limits  what was measured one way only is not checked; whether hammer or sensor is wrong is not
///         to be told by reciprocity. A structure with gyroscopic or active parts is not reciprocal
/// Source  ours, after Maxwell's reciprocal theorem
std::vector<DirectionDoubt> direction_doubts(const std::vector<FrequencyResponse>& responses,
                                             const FrfBand& band);

}  // namespace rvbench::analysis
