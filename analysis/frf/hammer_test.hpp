#pragma once

#include <vector>

#include "analysis/frf/frf_estimate.hpp"
#include "analysis/frf/hit_deviations.hpp"
#include "analysis/frf/hit_faults.hpp"

namespace rvbench::analysis {

/// All hits at one place: one record each, as find_hits() cuts them or the front end triggers.
struct HammerSeries {
  FrfSetup setup;  ///< one excitation
  std::vector<FrfRecord> hits;
};

/// How hits are windowed, judged and averaged.
struct HammerOptions {
  HitWindows windows = {};
  HitLimits limits = {};
  double least_share_of_median = 0.2;  ///< of the session's median peak; weaker hits are rejected
  double most_apart = 0.2;             ///< of distances_to_others(); hits further off are rejected
  FrfEstimator estimator = FrfEstimator::h1;
  FrfBand deviations_in = {};  ///< where hit_deviations() are kept, of H1; nowhere: to_Hz is 0
};

/// What came of the hits at one place.
struct HammerResult {
  std::vector<JudgedHit> hits;  ///< all, in their order: accepted, or why not
  FrfEstimates estimates;       ///< of the accepted ones; no responses if there is none
  std::vector<Eigen::MatrixXcf> deviations;  ///< of the accepted ones, if they were asked for
};

/// A whole session: judges each hit, averages those accepted at each place. An exponential window
/// is told in the notes of every response: its damping is in the response until
/// damping_without_window() takes it out of a mode.
///
/// Shape   one result for each series
/// Units   of the setups
/// Errors  throws std::invalid_argument of judge_hit() and hit_deviations(). What a record is
///         guilty of is a fault of the hit, another rate or length than that of the first accepted
///         one included
/// Source  Ewins, Modal Testing (2nd ed., 2000), ch. 3
std::vector<HammerResult> measure_session(const std::vector<HammerSeries>& session,
                                          const HammerOptions& options);

}  // namespace rvbench::analysis
