#include <algorithm>

#include "analysis/emd/outward_extrema.hpp"

namespace rvbench::analysis {
namespace {

using Extremum = OutwardExtrema::Extremum;

// The swings before the outermost extremum once more, in their width and their height. The signal
// has not turned between that one and its end.
void lay_swings_again(OutwardExtrema extrema) {
  const Extremum outermost = extrema.nth(0), next = extrema.nth(1), after = extrema.nth(2);
  const Extremum end = extrema.end();
  Extremum first{outermost.out + (next.out - after.out),
                 outermost.value + (next.value - after.value)};
  first.out = std::max(first.out, end.out);
  const bool is_minimum = outermost.value > next.value;
  first.value = is_minimum ? std::min(first.value, end.value) : std::max(first.value, end.value);
  extrema.lay(first);
  extrema.lay(
      {first.out + (outermost.out - next.out), first.value + (outermost.value - next.value)});
}

}  // namespace

const EndRule& slope_ends() {
  static constexpr EndRule rule = end_rule<lay_swings_again>("slope");
  return rule;
}

}  // namespace rvbench::analysis
