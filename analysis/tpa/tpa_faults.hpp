#pragma once

#include <string>
#include <vector>

#include "analysis/tpa/matrix_inverse.hpp"

namespace rvbench::analysis {

enum class TpaFaultKind {
  too_few_indicators,   ///< fewer than paths, or as many: nothing left to check by
  rank_below_paths,     ///< FRFs cannot tell all paths apart, by their own noise
  incoherent_lines,     ///< left out
  sign_reversed,        ///< of a sensor, in operation against the hammer test
  directions_swapped,   ///< as well
  missing_path,         ///< something else acts than the paths
  not_validated,        ///< the synthesis does not explain sensors that it was not fitted to
  halves_disagree,      ///< of the indicators, about blocked forces
  no_mount,             ///< a stiffness, damping or mass of one comes out negative
  references_together,  ///< they moved in fewer independent ways than there are
  frf_errors_unknown    ///< neither hits nor coherence tell how far FRFs are off
};

/// What is wrong with the data of an analysis, or with what may follow from it.
struct TpaFault {
  TpaFaultKind kind;
  std::string where;   ///< "J3 active +X", "at 312 of 991 lines"
  std::string reason;  ///< for people, with the numbers that say so
};

/// When something is called a fault.
struct TpaFaultLimits {
  double most_lines_below_rank = 0.5;  ///< share of the used lines
  double most_beyond_expected = 4;     ///< unexplained power over what is expected
  double least_unexplained = 0.02;     ///< share of the indicators' power; below, no path is missed
  double least_score = 0.8;            ///< over all lines
};

/// Faults that can be seen before anything is inverted: too few indicators, lines left out. Unequal
/// rates, missing sensors and pairs are faults of operating_spectra() and assemble_frf_matrix().
/// Errors  none thrown. Source  definition
std::vector<TpaFault> faults_before_inversion(Eigen::Index indicators, Eigen::Index paths,
                                              const std::vector<bool>& is_used);

/// Those that only the analysis shows. Where one sensor's sign or direction explains what is
/// outside the paths' reach, no path is said to be missing.
///
/// Rank is not asked for where the noise of the FRFs is not known, nor missing paths where their
/// variances are not; nor these and sensors where there are no more indicators than paths.
///
/// @param frfs, operating, roles  as given to the analysis. @param contributions  its result
/// Shape   any number, in the order of TpaFaultKind
/// Units   none
/// Errors  throws std::invalid_argument: lines or sensors that differ from those of the result
/// Source  unexplained_power(), find_sensor_change(), noise_floor(); the limits: ours
std::vector<TpaFault> faults_of_inversion(const FrfMatrix& frfs, const OperatingSpectra& operating,
                                          const SensorRoles& roles,
                                          const PathContributions& contributions,
                                          const TpaFaultLimits& limits = {});

/// Adds not_validated if a score, over all lines, is below the limit or not known.
/// Units  none. Errors  none thrown. Source  the limit: ours
void add_if_not_validated(double score, const TpaFaultLimits& limits,
                          std::vector<TpaFault>& faults);

}  // namespace rvbench::analysis
