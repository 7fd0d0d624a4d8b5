#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/emd/knots.hpp"

namespace rvbench::analysis {

/// How envelopes go on past the outermost extrema, so that they span the signal. A rule lays
/// further knots past either end, two at the least: one of each envelope at or before sample 0, or
/// at or after the last one. All still alternate.
///
/// Units   samples and the signal's own. Errors  none thrown: a sift sees to what a rule looks at
struct EndRule {
  const char* name;

  /// Before the first one. The first `looks_at` extrema or more are there, or all that there are,
  /// at least 3; with room before them for `looks_at` more.
  void (*start)(double first_sample, Knots& extrema);
  /// After the last one, which is before sample `last`.
  /// @param count  of all extrema of the signal, also of those that are dropped: only `looks_at` of
  ///               them must be left
  void (*end)(double last_sample, Eigen::Index last, std::size_t count, Knots& extrema);

  static constexpr std::size_t looks_at = 13;
};

/// One swing goes on past the end, with the mean values and the mean period of the last six of
/// each kind; an end sample that is further out than the first extremum so found takes its place.
/// Of what is to come, the mean is the guess with the least error: a mirror image is one that could
/// have been, and errs by its own chance as well.
///
/// Source  Huang et al., Proc. R. Soc. A 454, 903-995 (1998): characteristic waves
const EndRule& averaged_ends();

/// Extrema are mirrored, two of each kind. The axis is the outermost extremum if the end sample
/// lies between it and the next one and the mirrored ones reach past the end; otherwise the end
/// sample itself, which then counts as one.
///
/// Source  Rilling, Flandrin & Gonçalvès, IEEE-EURASIP NSIP-03 (2003)
const EndRule& mirrored_ends();

/// Each envelope has a knot at the end sample: where a line through the two outermost extrema of
/// its kind leads, unless the end sample is further out.
///
/// Source  Wu & Huang, Adv. Adapt. Data Anal. 1, 1-41 (2009)
const EndRule& linear_ends();

/// The last two swings go on past the end, as steep as they were; an end sample that is further out
/// than the first extremum so found takes its place. Both kinds keep the period of the outermost
/// extremum's kind: with one for each, those of an irregular signal would not alternate.
///
/// Source  Datig & Schlurmann, Ocean Eng. 31, 1783-1834 (2004); Wu & Qu, J. Sound Vib. 314, 586-602
///         (2008) for the end sample
const EndRule& slope_ends();

/// All of them.
/// Source  of each
const std::vector<const EndRule*>& end_rules();

}  // namespace rvbench::analysis
