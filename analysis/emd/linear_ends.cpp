#include <cmath>

#include "analysis/emd/end_rule.hpp"

namespace rvbench::analysis {
namespace {

// The value at `where` of an envelope whose two outermost extrema are `near` and `far`.
double extrapolated(const Knots& knots, std::size_t near, std::size_t far, double where) {
  const double slope = (knots.value[far] - knots.value[near]) / (knots.at[far] - knots.at[near]);
  return knots.value[near] + (where - knots.at[near]) * slope;
}

double further_out(bool is_upper, double a, double b) {
  return is_upper ? std::fmax(a, b) : std::fmin(a, b);
}

void line_start(double first_sample, Knots& extrema) {
  const std::size_t first = extrema.first, count = extrema.size();
  const bool is_maximum = extrema.value[first] > extrema.value[first + 1];
  const auto knot = [&](std::size_t of, bool is_upper) {
    if (count < of + 3) return first_sample;  // its kind has no second extremum
    return further_out(is_upper, first_sample,
                       extrapolated(extrema, first + of, first + of + 2, 0));
  };
  const double own = knot(0, is_maximum), other = knot(1, !is_maximum);
  extrema.push_front(0, other);
  extrema.push_front(0, own);
}

void line_end(double last_sample, Eigen::Index last, std::size_t count, Knots& extrema) {
  const std::size_t outermost = extrema.end - 1;
  const auto at = static_cast<double>(last);
  const bool is_maximum = extrema.value[outermost] > extrema.value[outermost - 1];
  const auto knot = [&](std::size_t of, bool is_upper) {
    if (count < of + 3) return last_sample;
    return further_out(is_upper, last_sample,
                       extrapolated(extrema, outermost - of, outermost - of - 2, at));
  };
  const double own = knot(0, is_maximum), other = knot(1, !is_maximum);
  extrema.push_back(at, other);
  extrema.push_back(at, own);
}

}  // namespace

const EndRule& linear_ends() {
  static constexpr EndRule rule{"linear", line_start, line_end};
  return rule;
}

}  // namespace rvbench::analysis
