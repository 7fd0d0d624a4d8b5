#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/tpa/contribution_ranking.hpp"
#include "analysis/tpa/frf_draws.hpp"

namespace rvbench::analysis {

/// How often an analysis is done again.
struct Resampling {
  int replicates = 100;  ///< 20 at least
  std::uint64_t seed = 1;
};

/// Bounds that hold a value in 95 % of cases.
struct Interval95 {
  double low = 0, high = 0;
};

/// How sure a ranking is; paths in the ranking's order.
struct RankingCertainty {
  std::vector<Interval95> rms;     ///< of each path
  std::vector<double> order_held;  ///< [i]: share of replicates with path i above path i + 1
  std::vector<double> led;         ///< [i]: share of replicates in which path i led all others

  /// Whether path i can be told to contribute more than the one after it.
  bool can_tell(std::size_t i) const { return order_held.at(i) >= 0.95; }

  /// The path, of those after the first, that led most often; the second if none did. Needs two.
  std::size_t rival() const {
    return std::size_t(std::max_element(led.begin() + 1, led.end()) - led.begin());
  }
};

/// An analysis by other FRFs, over these blocks of operation, in no order, some of them twice or
/// more. It is called by several threads at a time.
using PathAnalysis = std::function<PathContributions(const FrfMatrix& frfs,
                                                     const std::vector<Eigen::Index>& blocks)>;

/// Does the analysis anew with blocks drawn with replacement and FRFs drawn anew.
///
/// Replicates err about the estimate as that does about the truth: what errors add to a
/// contribution's mean square they add twice. Each replicate speaks for estimate² + (estimate² -
/// replicate²), not below 0: the basic bootstrap, of mean squares; intervals and orders alike.
///
/// @param draw      of the FRFs that rankings were made by
/// @param blocks    how many there are
/// @param rankings  of rank_contributions()
/// Shape   one per ranking
/// Units   those of the ranking
/// Errors  throws std::invalid_argument: fewer than 20 replicates, no block; and what the analysis
///         throws
/// Threads up to `threads` (0: the free cores); the result does not depend on them
/// Limits  blocks that overlap are not quite independent; steady lines do not vary by blocks
/// Source  Davison & Hinkley, Bootstrap Methods and their Application (1997), sec. 2.4, 5.2
std::vector<RankingCertainty> ranking_certainty(const FrfDraw& draw, Eigen::Index blocks,
                                                const PathAnalysis& analysis,
                                                const std::vector<TargetRanking>& rankings,
                                                const Resampling& resampling = {},
                                                unsigned threads = 0);

}  // namespace rvbench::analysis
