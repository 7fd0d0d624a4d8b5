#include <algorithm>

#include "analysis/emd/outward_extrema.hpp"

namespace rvbench::analysis {
namespace {

using Extremum = OutwardExtrema::Extremum;

// As many of either kind: fewer follow chance, and many more what a record no longer does.
constexpr std::size_t waves = 6;
static_assert(2 * waves + 1 == EndRule::looks_at);

void lay_mean_wave(OutwardExtrema extrema) {
  const std::size_t count = std::min(extrema.count(), EndRule::looks_at);
  const std::size_t averaged = std::min(waves, count / 2);
  double own = 0, other = 0;
  for (std::size_t i = 0; i < averaged; ++i) {
    own += extrema.nth(2 * i).value / double(averaged);
    other += extrema.nth(2 * i + 1).value / double(averaged);
  }
  const std::size_t swings = std::min(2 * averaged, count - 1);
  const Extremum outermost = extrema.nth(0), end = extrema.end();
  const double half_period = (outermost.out - extrema.nth(swings).out) / double(swings);
  // The signal has not turned between the outermost extremum and its end.
  const bool falls = outermost.value > extrema.nth(1).value;
  const Extremum first{std::max(outermost.out + half_period, end.out),
                       falls ? std::min(other, end.value) : std::max(other, end.value)};
  extrema.lay(first);
  extrema.lay(
      {first.out + half_period, falls ? std::max(own, first.value) : std::min(own, first.value)});
}

}  // namespace

const EndRule& averaged_ends() {
  static constexpr EndRule rule = end_rule<lay_mean_wave>("averaged");
  return rule;
}

}  // namespace rvbench::analysis
