#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// Steps of the converter from a crest of equal samples to its neighbours: three samples of a
/// parabola within one step have neighbours within four, and it rounds by one more.
inline constexpr double steps_of_crest = 5;

/// Samples that a rail holds, of a signal whose full scale is not known: at the top and at the
/// bottom, each looked at by itself, and both as one, for a fast signal goes from rail to rail.
///
/// A rail is, first, the outermost value that three samples in a row or more have, if
///
///     few pass it       at most a tenth as many as it holds: glitches
///     the signal jumps  on average its neighbours are more than `steps_of_crest` away, and more
///                       than 3 % of the rms change from sample to sample
///     it does not rest  it holds less than three quarters of all samples, as a force does not
///                       that acts in pulses
///
/// and 1 % of all samples are in no such run, wherever it lies: else the signal is made of
/// plateaus.
///
/// It is, secondly, the outermost value that ten samples or more have, in a row or each alone, as
/// those of a fast signal that is clipped on one side are, if few pass it, the signal jumps to it
/// and does not rest at it, all as above, and ten times as many samples have it as have any of the
/// five values next to it further in. Values of noise become rarer outwards, however coarse the
/// converter's steps; a crest's oftenest value is its outermost one, by 2.4 at the most where it is
/// a parabola, 5.3 where it is as flat as a fourth power.
///
/// Shape   N samples, all finite → 0 to N
/// Limits  what goes unseen: a rail that flickers by a step, one within five steps of what is
///         beside it, or cut off no more than ten steps' worth of samples where it holds no three
///         in a row
/// Errors  none thrown. Source  ours
Eigen::Index clipped_samples(const Eigen::Ref<const Eigen::VectorXd>& x);

}  // namespace rvbench::analysis
