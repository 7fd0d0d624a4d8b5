#include <algorithm>
#include <vector>

#include "analysis/emd/outward_extrema.hpp"

namespace rvbench::analysis {
namespace {

using Extremum = OutwardExtrema::Extremum;

// Two of each kind, as in the source. More change little.
constexpr std::size_t most_mirrored = 4;
static_assert(most_mirrored + 1 <= EndRule::looks_at);

Extremum reflected(Extremum e, double axis) { return {2 * axis - e.out, e.value}; }

// The mirrored extrema past one end, nearest first.
std::vector<Extremum> past_end(const OutwardExtrema& extrema) {
  const Extremum end = extrema.end(), outermost = extrema.nth(0), next = extrema.nth(1);
  const bool end_lies_between =
      outermost.value > next.value ? end.value > next.value : end.value < next.value;

  std::vector<Extremum> out;
  if (end_lies_between) {
    for (std::size_t i = 1; i <= std::min(extrema.count() - 1, most_mirrored); ++i) {
      out.push_back(reflected(extrema.nth(i), outermost.out));
    }
    const bool span = out[out.size() - 2].out >= end.out;  // one of each kind past the end
    if (span) return out;
    out.clear();
  }
  out.push_back(end);
  for (std::size_t i = 0; i < std::min(extrema.count(), most_mirrored); ++i) {
    out.push_back(reflected(extrema.nth(i), end.out));
  }
  return out;
}

void lay_mirrored(OutwardExtrema extrema) {
  for (const Extremum& e : past_end(extrema)) extrema.lay(e);
}

}  // namespace

const EndRule& mirrored_ends() {
  static constexpr EndRule rule = end_rule<lay_mirrored>("mirrored");
  return rule;
}

}  // namespace rvbench::analysis
