#include <algorithm>

#include "analysis/emd/end_rule.hpp"

namespace rvbench::analysis {
namespace {

// As many of either kind: fewer follow chance, and many more what a record no longer does.
constexpr std::size_t waves = 6;
static_assert(2 * waves + 1 == EndRule::looks_at);

// An extremum as seen from an end: `out` grows towards it and beyond.
struct Extremum {
  double out = 0;
  double value = 0;
};

struct Beyond {
  Extremum first, second;
};

// nth(0) is the outermost extremum of that end.
template <class Nth>
Beyond mean_wave(Extremum end, Nth nth, std::size_t count) {
  const std::size_t averaged = std::min(waves, count / 2);
  double own = 0, other = 0;
  for (std::size_t i = 0; i < averaged; ++i) {
    own += nth(2 * i).value / double(averaged);
    other += nth(2 * i + 1).value / double(averaged);
  }
  const std::size_t swings = std::min(2 * averaged, count - 1);
  const Extremum outermost = nth(0);
  const double half_period = (outermost.out - nth(swings).out) / double(swings);
  // The signal has not turned between the outermost extremum and its end.
  const bool falls = outermost.value > nth(1).value;
  const Extremum first{std::max(outermost.out + half_period, end.out),
                       falls ? std::min(other, end.value) : std::max(other, end.value)};
  return {
      first,
      {first.out + half_period, falls ? std::max(own, first.value) : std::min(own, first.value)}};
}

void averaged_start(double first_sample, Knots& extrema) {
  const auto nth = [&](std::size_t i) {
    return Extremum{-extrema.at[extrema.first + i], extrema.value[extrema.first + i]};
  };
  const std::size_t count = std::min(extrema.size(), EndRule::looks_at);
  const Beyond beyond = mean_wave({0, first_sample}, nth, count);
  extrema.push_front(-beyond.first.out, beyond.first.value);
  extrema.push_front(-beyond.second.out, beyond.second.value);
}

void averaged_end(double last_sample, Eigen::Index last, std::size_t count, Knots& extrema) {
  const auto nth = [&](std::size_t i) {
    return Extremum{extrema.at[extrema.end - 1 - i], extrema.value[extrema.end - 1 - i]};
  };
  const Beyond beyond =
      mean_wave({static_cast<double>(last), last_sample}, nth, std::min(count, EndRule::looks_at));
  extrema.push_back(beyond.first.out, beyond.first.value);
  extrema.push_back(beyond.second.out, beyond.second.value);
}

}  // namespace

const EndRule& averaged_ends() {
  static constexpr EndRule rule{"averaged", averaged_start, averaged_end};
  return rule;
}

}  // namespace rvbench::analysis
