#pragma once

#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Lines that a shaft sheds, and where to look for them.
struct ShaftLines {
  std::vector<double> orders;   ///< events per turn, > 0
  double turns_per_sample = 0;  ///< about; > 0
  double within = 0.03;         ///< relative: how far the speed may be off that, in (0, 0.5)
};

struct ShaftSpeed {
  double turns_per_sample = not_known;  ///< NaN if the lines are not seen
  double standard_error = not_known;    ///< by how far the lines disagree
  std::size_t seen = 0;                 ///< of the orders: above what noise raises once in 100
};

/// Speed of a shaft in each block of a record, from vibration alone: where its lines stand highest
/// together.
///
///     S(f) = Σ_order Σ_channel ln(1 + P(order·f) / floor),   f̂ = argmax S
///
/// P is the Hann periodogram, the floor its median around the line. The logarithm lets no line
/// speak louder than the others, however strong: not one that is swamped by a neighbour, either.
///
/// Shape   blocks of `block` samples, each half a block after the last; empty if not one fits
/// Units   turns per sample: no rate is needed
/// Errors  standard_error = √(Σ s'²) / |Σ s''|, s the summands of S at f̂: each line is a witness.
///         Not seen where not more than half of the orders stand out at f̂, or a sample is not
///         finite. Throws std::invalid_argument: no order, a value out of range, an order beyond
///         half the sample rate, a block of less than 64 samples, channels of unequal length
/// Limits  a family in the same ratios at another order looks the same; a change of speed within a
///         block is averaged
/// Source  Leclère, André & Antoni, A multi-order probabilistic approach for Instantaneous Angular
///         Speed tracking: debriefing of the CMMNO'14 diagnosis contest, Mech. Syst. Signal
///         Process. (2016); errors: Huber, Proc. 5th Berkeley Symp. 1, 221-233 (1967)
std::vector<ShaftSpeed> shaft_speeds(const std::vector<Channel>& channels, const ShaftLines& lines,
                                     Eigen::Index block);

}  // namespace rvbench::analysis
