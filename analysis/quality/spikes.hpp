#pragma once

#include <Eigen/Core>
#include <vector>

namespace rvbench::analysis {

/// Samples that jump as nothing that was struck can: a loose plug, a discharge, a lost bit.
///
/// What is struck swings on. A mode of damping ratio ζ still has exp(−2πζ) of its size after one
/// period, and the shortest period that samples can hold is two of them: five samples after a
/// strike a mode of ζ < 0.14 still has a tenth of its size, a slower one more, and machines have
/// ζ of a few percent. So a jump is told by what is missing around it: the signal goes on as if
/// nothing had been.
///
///     c     the cubic of least squares through x_k, 4 < |k − i| ≤ 20
///     |x_i − c_i| ≥ 10·max |x_k − c_k|;  ≥ 20 steps of the converter;  and ≥ 8 rms above the
///     cubic through two neighbours on either side
///
/// Shape   N samples → the indices of the jumps, one or two samples wide, in rising order
/// Limits  found from 10 times the largest swing within 20 samples on, less where that is slow: in
///         white noise of variance 1 from 40 on. A jump ahead of a steep anti-alias filter rings as
///         that filter does, and is not found. A resonance far above the sample rate, recorded
///         without such a filter, leaves a jump per strike: whoever knows how often parts meet must
///         weigh the number
/// Errors  throws std::invalid_argument: sample not finite
/// Units   those of x, samples. Source  ours, from the decay of what is struck, as above
std::vector<Eigen::Index> find_spikes(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
