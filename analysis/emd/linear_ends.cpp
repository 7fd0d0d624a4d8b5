#include <cmath>

#include "analysis/emd/outward_extrema.hpp"

namespace rvbench::analysis {
namespace {

using Extremum = OutwardExtrema::Extremum;

// The value at `out` of an envelope whose two outermost extrema are `near` and `far`.
double extrapolated(Extremum near, Extremum far, double out) {
  const double slope = (far.value - near.value) / (far.out - near.out);
  return near.value + (out - near.out) * slope;
}

void lay_on_lines(OutwardExtrema extrema) {
  const Extremum end = extrema.end();
  const bool is_maximum = extrema.nth(0).value > extrema.nth(1).value;
  const auto knot = [&](std::size_t of, bool is_upper) -> Extremum {
    if (extrema.count() < of + 3) return end;  // its kind has no second extremum
    const double there = extrapolated(extrema.nth(of), extrema.nth(of + 2), end.out);
    return {end.out, is_upper ? std::fmax(end.value, there) : std::fmin(end.value, there)};
  };
  extrema.lay(knot(1, !is_maximum));
  extrema.lay(knot(0, is_maximum));
}

}  // namespace

const EndRule& linear_ends() {
  static constexpr EndRule rule = end_rule<lay_on_lines>("linear");
  return rule;
}

}  // namespace rvbench::analysis
