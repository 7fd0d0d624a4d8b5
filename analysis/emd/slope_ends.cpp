#include <algorithm>
#include <cmath>

#include "analysis/emd/end_rule.hpp"

namespace rvbench::analysis {
namespace {

// An extremum as seen from an end: `out` grows towards it and beyond.
struct Extremum {
  double out = 0;
  double value = 0;
};

struct Beyond {
  Extremum first, second;
};

// The extrema past one end: the swings before the outermost one once more, in their width and their
// height. The signal has not turned between the outermost extremum and its end.
// @param outermost, next, after  of that end
Beyond swings_again(Extremum end, Extremum outermost, Extremum next, Extremum after) {
  Extremum first{outermost.out + (next.out - after.out),
                 outermost.value + (next.value - after.value)};
  first.out = std::max(first.out, end.out);
  const bool is_minimum = outermost.value > next.value;
  first.value = is_minimum ? std::min(first.value, end.value) : std::max(first.value, end.value);
  const Extremum second{first.out + (outermost.out - next.out),
                        first.value + (outermost.value - next.value)};
  return {first, second};
}

void slope_start(double first_sample, Knots& extrema) {
  const auto nth = [&](std::size_t i) {
    return Extremum{-extrema.at[extrema.first + i], extrema.value[extrema.first + i]};
  };
  const Beyond beyond = swings_again({0, first_sample}, nth(0), nth(1), nth(2));
  extrema.push_front(-beyond.first.out, beyond.first.value);
  extrema.push_front(-beyond.second.out, beyond.second.value);
}

void slope_end(double last_sample, Eigen::Index last, std::size_t /*count*/, Knots& extrema) {
  const auto nth = [&](std::size_t i) {
    return Extremum{extrema.at[extrema.end - 1 - i], extrema.value[extrema.end - 1 - i]};
  };
  const Beyond beyond =
      swings_again({static_cast<double>(last), last_sample}, nth(0), nth(1), nth(2));
  extrema.push_back(beyond.first.out, beyond.first.value);
  extrema.push_back(beyond.second.out, beyond.second.value);
}

}  // namespace

const EndRule& slope_ends() {
  static constexpr EndRule rule{"slope", slope_start, slope_end};
  return rule;
}

}  // namespace rvbench::analysis
