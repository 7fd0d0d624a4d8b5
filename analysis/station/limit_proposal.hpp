#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/station/robust_limit.hpp"

namespace rvbench::analysis {

/// Values of one indicator at one point of the matrix: of good units to learn from, and of all
/// units ever judged there.
struct IndicatorHistory {
  std::string indicator;  ///< as limits name it: "acceleration_rms"
  std::string point;      ///< "1815 rpm, 100 % load"
  LimitSide side = LimitSide::max;
  std::vector<double> good;     ///< one a unit
  std::vector<double> history;  ///< one a unit; may hold the good ones
  bool has_limit = false;       ///< whether `limit` is in force
  double limit = 0;             ///< under which history was judged
};

/// A limit for somebody to approve, with what it would have done.
struct LimitProposal {
  std::string indicator, point;
  LimitSide side = LimitSide::max;
  std::string refusal;         ///< why there is none; empty if there is one
  RobustLimit learnt;          ///< by which it is proposed
  std::size_t judged = 0;      ///< of history
  std::size_t beyond = 0;      ///< of it beyond the proposal
  std::size_t would_fail = 0;  ///< of it beyond the proposal, within the limit in force
  std::size_t would_pass = 0;  ///< within the proposal, beyond the limit in force
  bool good_beyond = false;    ///< a unit that it was learnt from is beyond it

  /// Of history, 0 to 1; 0 if there is none. Without a limit in force all was within.
  double share_that_changes() const;
};

/// One proposal for each, in their order.
///
/// Units   of the values. Errors  throws std::invalid_argument: a value not finite, coverage out of
///         range; what cannot be proposed has a refusal
/// Source  robust_limit()
std::vector<LimitProposal> propose_limits(const std::vector<IndicatorHistory>& histories,
                                          const Coverage& coverage = {});

}  // namespace rvbench::analysis
