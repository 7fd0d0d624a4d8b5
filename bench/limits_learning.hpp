#pragma once

#include <set>
#include <string>
#include <variant>
#include <vector>

#include "analysis/station/limit_proposal.hpp"
#include "bench/limits_file.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {

/// What limits are to be learnt, and from whom.
struct LearningTask {
  std::string version;
  sequences::TestPlan plan;  ///< with the limits in force: what is not learnt stays as it is
  std::vector<std::string> measures;  ///< to learn; empty: those that are limited, and depths
  std::vector<std::string> parts;     ///< of the specimen: whose depths are learnt, each by itself
  std::string rig_kind = {};          ///< on which they ran: kinds are never mixed
  bool per_point = false;         ///< a limit for each point of the matrix, in place of one for all
  std::set<std::string> serials;  ///< good units; empty: all that passed
  analysis::Coverage coverage;
};

/// One limit that good units were asked for.
struct LearntLimit {
  sequences::Limit limit;              ///< the proposed one, or that in force if there is none
  double in_force = 0;                 ///< at its points, the strictest; NaN if there is none
  analysis::LimitProposal proposal;    ///< in the limit's unit
  std::vector<std::string> set_aside;  ///< serials of good units that are unlike the others

  /// Whether so many are that the others' scatter does not tell how many of all the limit leaves
  /// within: they are skewed, or of two kinds.
  bool is_doubtful() const { return 10 * set_aside.size() > proposal.learnt.units; }
};

struct LearntLimits {
  LimitsFile file;                   ///< a draft: what was learnt, and what stays; no steps
  std::vector<LearntLimit> learnt;   ///< those that were refused, too
  std::vector<std::string> changed;  ///< folders of runs that are gone or were changed: no teachers
};

/// Learns limits from the newest PASS of each good unit that no FAIL came after: of each the worst
/// value over all channels of the points that the limit is for, as it is held against it. A limit
/// for a point is added to one for all points that is in force: both hold.
/// @param utc  of now, for the reasons
/// A depth that is not shown counts as what noise may hide.
/// Units   of the limit in force, else of the measure. Errors  as ResultDatabase; too few units are
///         a refusal of that limit. @throws std::invalid_argument as propose_limits()
/// Source  analysis::propose_limits()
Result<LearntLimits> learn_limits(const ResultDatabase& database, const LearningTask& task,
                                  const std::string& utc);

/// The kinds of rig on which units passed the plan, by runs that are as they were entered: "bench",
/// "replay", "sim".
Result<std::set<std::string>> rig_kinds_of(const ResultDatabase& database, const std::string& plan);

/// One a line, in a text with line ends of any computer; without the empty ones.
std::set<std::string> serials_in(const std::string& text);

/// Of these the one to learn from: real units before simulated ones. Empty: of none.
std::string kind_to_learn_from(const std::set<std::string>& kinds);

/// A table, a row each, with what is refused and why.
std::string learnt_text(const LearntLimits& learnt);

}  // namespace rvbench::bench
