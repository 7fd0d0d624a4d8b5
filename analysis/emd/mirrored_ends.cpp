#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/emd/end_rule.hpp"

namespace rvbench::analysis {
namespace {

// Two of each kind, as in the source. More change little.
constexpr std::size_t most_mirrored = 4;
static_assert(most_mirrored + 1 <= EndRule::looks_at);

struct Extremum {
  double at = 0;
  double value = 0;
};

Extremum reflected(Extremum e, double axis) { return {2 * axis - e.at, e.value}; }

// The mirrored extrema past one end, nearest first. nth(0) is the outermost extremum of that end.
template <class Nth>
std::vector<Extremum> past_end(Extremum end, Nth nth, std::size_t count) {
  const Extremum outermost = nth(0), next = nth(1);
  const bool end_lies_between =
      outermost.value > next.value ? end.value > next.value : end.value < next.value;

  std::vector<Extremum> out;
  if (end_lies_between) {
    for (std::size_t i = 1; i <= std::min(count - 1, most_mirrored); ++i) {
      out.push_back(reflected(nth(i), outermost.at));
    }
    // One of each kind past the end: the distances from the axis tell for either end.
    const double to_end = std::abs(end.at - outermost.at);
    const bool span = std::abs(out[out.size() - 2].at - outermost.at) >= to_end;
    if (span) return out;
    out.clear();
  }
  out.push_back(end);
  for (std::size_t i = 0; i < std::min(count, most_mirrored); ++i) {
    out.push_back(reflected(nth(i), end.at));
  }
  return out;
}

void mirror_start(double first_sample, Knots& extrema) {
  const auto nth = [&](std::size_t i) {
    return Extremum{extrema.at[extrema.first + i], extrema.value[extrema.first + i]};
  };
  for (const Extremum& e : past_end({0, first_sample}, nth, extrema.size())) {
    extrema.push_front(e.at, e.value);
  }
}

void mirror_end(double last_sample, Eigen::Index last, std::size_t count, Knots& extrema) {
  const auto nth = [&](std::size_t i) {
    return Extremum{extrema.at[extrema.end - 1 - i], extrema.value[extrema.end - 1 - i]};
  };
  for (const Extremum& e : past_end({static_cast<double>(last), last_sample}, nth, count)) {
    extrema.push_back(e.at, e.value);
  }
}

}  // namespace

const EndRule& mirrored_ends() {
  static constexpr EndRule rule{"mirrored", mirror_start, mirror_end};
  return rule;
}

}  // namespace rvbench::analysis
