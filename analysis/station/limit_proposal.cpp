#include "analysis/station/limit_proposal.hpp"

#include <algorithm>
#include <map>

namespace rvbench::analysis {
namespace {

bool is_beyond(double value, double limit, LimitSide side) {
  return side == LimitSide::max ? value > limit : value < limit;
}

void hold_against_history(const IndicatorHistory& of, LimitProposal& proposal) {
  proposal.judged = of.history.size();
  for (const double value : of.history) {
    const bool would = is_beyond(value, proposal.learnt.limit, of.side);
    const bool did = of.has_limit && is_beyond(value, of.limit, of.side);
    proposal.beyond += would ? 1 : 0;
    proposal.would_fail += would && !did ? 1 : 0;
    proposal.would_pass += did && !would ? 1 : 0;
  }
}

}  // namespace

double LimitProposal::share_that_changes() const {
  return judged == 0 ? 0 : double(would_fail + would_pass) / double(judged);
}

std::vector<LimitProposal> propose_limits(const std::vector<IndicatorHistory>& histories,
                                          const Coverage& coverage) {
  std::map<std::size_t, double> factors;  // simulated once for each number of units
  std::vector<LimitProposal> proposals;
  for (const IndicatorHistory& of : histories) {
    LimitProposal& proposal = proposals.emplace_back();
    proposal.indicator = of.indicator;
    proposal.point = of.point;
    proposal.side = of.side;
    const std::size_t units = of.good.size();
    double factor = 0;
    if (units >= least_units_of_a_limit) {
      const auto [at, is_new] = factors.try_emplace(units, 0.0);
      if (is_new) at->second = robust_tolerance_factor(units, coverage);
      factor = at->second;
    }
    const auto learnt = robust_limit(of.good, of.side, factor);
    if (const auto* refusal = std::get_if<std::string>(&learnt)) {
      proposal.refusal = *refusal;
      continue;
    }
    proposal.learnt = std::get<RobustLimit>(learnt);
    hold_against_history(of, proposal);
    proposal.good_beyond = std::ranges::any_of(
        of.good, [&](double value) { return is_beyond(value, proposal.learnt.limit, of.side); });
  }
  return proposals;
}

}  // namespace rvbench::analysis
