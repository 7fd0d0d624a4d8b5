#pragma once

#include <string>
#include <vector>

#include "analysis/tpa/matrix_inverse.hpp"

namespace rvbench::analysis {

/// What a source would push with against an interface that does not move, found in place, and how
/// far it can be believed.
struct BlockedForces {
  PathContributions contributions;  ///< forces are the blocked ones; it holds the score at sensors
                                    ///< that were not fitted to
  /// Σ|F₁ - F₂|² / Σ|F|² over the used lines, F₁ and F₂ from every other indicator each: as large
  /// as 2 where halves agree on nothing. NaN where a half has no more indicators than paths: rules
  /// that ask the data need some to spare.
  double disagreement = 0;
};

/// In-situ blocked forces: with FRFs of the machine as assembled, hit at the interface between a
/// source and what carries it, and indicators on the carrying side alone,
///
///     F_bl = H⁺·A
///
/// are the source's own: what carries it may change, and they predict what it then does to it. The
/// equation is that of matrix_inverse_contributions(); what makes its forces blocked ones is where
/// is hit and where is listened, and that is checked.
///
/// @param source  points inside the source: no sensor that is used may be at one of them
/// Shape   lines of the FRFs, blocks of the spectra
/// Units   forces in the unit of excitation
/// Errors  throws std::invalid_argument of matrix_inverse_contributions(); no point of the source
///         given, a sensor at one
/// Limits  an interface of which not all directions were hit, moments included, is not blocked in
///         those: its score at unused sensors falls, and the forces change with what carries it
/// Source  ISO 20270:2019; Moorhouse, Elliott & Evans, J. Sound Vib. 325(4-5), 679-685 (2009)
BlockedForces blocked_forces(const FrfMatrix& frfs, const OperatingSpectra& operating,
                             const SensorRoles& roles, const std::vector<std::string>& source,
                             const RegularisationRule& rule, std::vector<bool> is_used = {},
                             unsigned threads = 0);

}  // namespace rvbench::analysis
