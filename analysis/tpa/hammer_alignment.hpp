#pragma once

#include "analysis/tpa/frf_draws.hpp"

namespace rvbench::analysis {

/// How blows of a hammer were turned against the sensors at the same points, as reciprocity tells.
struct HammerAlignment {
  Eigen::MatrixXd mixing;  ///< columns x columns: measured = aligned·(I + mixing); (k, j): how much
                           ///< of direction k blows at j had. 0 between points
  double asymmetry_before = 0;  ///< RMS of H_ij - H_ji over that of H_ij, pairs weighted as above
  double asymmetry_after = 0;   ///< 0 where a blow would be off by too much
  bool is_used = false;  ///< not where nothing tells, or where a blow would be off by too much

  /// The largest turn of a blow: of mixing between directions.
  double largest_turn_rad() const;
};

/// Finds the alignment from the rows at the places that were hit: H_ij = H_ji of a structure that
/// is linear and at rest, whatever it is. All lines and all pairs of such places have their say
/// about one mixing per point, real and the same at all lines:
///
///     R' - R'ᵀ = R'·E - (R'·E)ᵀ,   least squares, each pair by its noise and 1 % of its size;
///                                  twice, the second time on what the first has aligned
///
/// Only ratios of strengths can be told: their mean is left as it was. A contribution of a path
/// does not depend on them; it does on what blows had of other directions.
///
/// Not used: fewer than two places with a row of their own, fewer than 64 lines, mixing above 0.2
/// (12 degrees), or an asymmetry that does not fall, by a tenth, at stretches of 32 lines that
/// the mixing of the stretches between foresees: what a sensor's lever or noise breaks, no mixing
/// that is the same at all lines can mend.
///
/// Shape   any; of it the columns that have a row at their place
/// Units   none
/// Errors  none thrown
/// Limits  sensors that are turned cannot be told from a hammer that is: directions are then those
///         of the sensors. A sensor beside the place that is hit breaks reciprocity by its lever,
///         which no turn can mend
/// Source  Ewins, Modal Testing (2nd ed., 2000), sec. 3.9: reciprocity as check; as an equation for
///         the hammer: ours
HammerAlignment hammer_alignment(const FrfMatrix& frfs);

/// FRFs from blows along the sensors' directions, with what is known of their errors.
/// Errors, source  of hammer_alignment()
FrfMatrix aligned_frfs(FrfMatrix frfs, const HammerAlignment& alignment);

/// Draws of FRFs whose alignment is used: each is aligned by a mixing of its own, whatever it is.
FrfDraw aligned_draws(FrfDraw draw);

}  // namespace rvbench::analysis
