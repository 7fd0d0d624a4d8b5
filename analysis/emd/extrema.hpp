#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace rvbench::analysis {

/// Extrema in the order of time; maxima and minima alternate.
struct Extrema {
  std::vector<double> at;     ///< in samples; half-integer at the middle of an even plateau
  std::vector<double> value;  ///< of the signal there
  std::size_t count = 0;      ///< how many of both hold; what follows is room for more
};

/// Finds the interior extrema of h; a plateau counts as one extremum at its middle.
/// What `found` held before is replaced.
void find_extrema(const Eigen::Ref<const Eigen::VectorXd>& h, Extrema& found);

/// Mirrors the extrema at both ends of h, so that envelopes through them span the whole signal.
///
/// The axis is the outermost extremum if the end sample lies between it and the next one and the
/// mirrored ones reach past the end; otherwise the end sample itself, which then counts as one.
///
/// Shape   at least 3 extrema, as find_extrema(h) gave them; they still alternate afterwards
/// Source  Rilling, Flandrin & Gonçalvès, IEEE-EURASIP NSIP-03 (2003)
void mirror_ends(const Eigen::Ref<const Eigen::VectorXd>& h, Extrema& extrema);

}  // namespace rvbench::analysis
