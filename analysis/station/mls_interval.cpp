#include "analysis/station/mls_interval.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/station/distributions.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

double square(double x) { return x * x; }

// How far the true mean square may be below the measured one, and above it, as shares of that.
double share_below(const MeanSquareTerm& t, double tail) {
  return 1 - t.freedom / chi_square_quantile(1 - tail, t.freedom);
}
double share_above(const MeanSquareTerm& t, double tail) {
  return t.freedom / chi_square_quantile(tail, t.freedom) - 1;
}

// Of a term that adds and one that takes away: what makes the interval exact where these two are
// all, and its end is 0.
double mixed_below(const MeanSquareTerm& adds, const MeanSquareTerm& takes, double tail) {
  const double f = f_quantile(1 - tail, adds.freedom, takes.freedom);
  return (square(f - 1) - square(share_below(adds, tail) * f) - square(share_above(takes, tail))) /
         f;
}
double mixed_above(const MeanSquareTerm& adds, const MeanSquareTerm& takes, double tail) {
  const double f = f_quantile(tail, adds.freedom, takes.freedom);
  return (square(1 - f) - square(share_above(adds, tail) * f) - square(share_below(takes, tail))) /
         f;
}

}  // namespace

ConfidenceInterval mls_interval(const std::vector<MeanSquareTerm>& terms, double confidence) {
  constexpr Require require{"mls_interval"};
  require(!terms.empty(), "no term");
  require(confidence > 0 && confidence < 1, "the confidence is a share between 0 and 1");
  const double tail = (1 - confidence) / 2;
  double sum = 0, below = 0, above = 0;
  for (const MeanSquareTerm& t : terms) {
    const double part = t.coefficient * t.mean_square;
    const bool adds = t.coefficient > 0;
    sum += part;
    below += square(part * (adds ? share_below(t, tail) : share_above(t, tail)));
    above += square(part * (adds ? share_above(t, tail) : share_below(t, tail)));
  }
  for (const MeanSquareTerm& q : terms) {
    for (const MeanSquareTerm& r : terms) {
      if (!(q.coefficient > 0 && r.coefficient < 0)) continue;
      const double parts = -q.coefficient * r.coefficient * q.mean_square * r.mean_square;
      below += parts * mixed_below(q, r, tail);
      above += parts * mixed_above(q, r, tail);
    }
  }
  return {sum - std::sqrt(std::max(below, 0.0)), sum + std::sqrt(std::max(above, 0.0))};
}

}  // namespace rvbench::analysis
