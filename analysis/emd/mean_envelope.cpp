#include "analysis/emd/mean_envelope.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// value + slope·u + half_curvature·u² + cubic·u³
struct Cubic {
  double value, slope, half_curvature, cubic;

  // The same polynomial about a point s later.
  Cubic moved(double s) const {
    return {value + s * (slope + s * (half_curvature + s * cubic)),
            slope + s * (2 * half_curvature + 3 * s * cubic), half_curvature + 3 * s * cubic,
            cubic};
  }
};

Cubic mean(const Cubic& a, const Cubic& b) {
  return {0.5 * (a.value + b.value), 0.5 * (a.slope + b.slope),
          0.5 * (a.half_curvature + b.half_curvature), 0.5 * (a.cubic + b.cubic)};
}

}  // namespace

void MeanEnvelope::subtract_from(Eigen::Ref<Eigen::VectorXd> h, const Extrema& extrema) {
  solve(extrema);
  const double* at = extrema.at.data();
  const double* value = extrema.value.data();
  // The spline through knots j and j + 2, about knot j.
  const auto segment = [&](std::size_t j) {
    const double width = at[j + 2] - at[j];
    const double m = curvature_[j], m_next = curvature_[j + 2];
    return Cubic{value[j], (value[j + 2] - value[j]) / width - width * (2 * m + m_next) / 6, m / 2,
                 (m_next - m) / (6 * width)};
  };

  const Eigen::Index n = h.size();
  double* samples = h.data();
  Eigen::Index i = 0;
  Cubic other = segment(0);
  for (std::size_t j = 1; j + 2 < extrema.count && i < n; ++j) {
    const Cubic own = segment(j);
    const Cubic m = mean(own, other.moved(at[j] - at[j - 1]));
    other = own;
    const bool is_last = j + 3 == extrema.count;
    const auto end = is_last ? n : std::min(n, static_cast<Eigen::Index>(std::ceil(at[j + 1])));
    for (; i < end; ++i) {
      const double u = static_cast<double>(i) - at[j];
      samples[i] -= m.value + u * (m.slope + u * (m.half_curvature + u * m.cubic));
    }
  }
}

// Every second knot belongs to the same spline: two tridiagonal systems of one shape, solved side
// by side so that the processor can overlap their divisions.
void MeanEnvelope::solve(const Extrema& extrema) {
  const std::size_t count = extrema.count;
  if (curvature_.size() < count) {
    curvature_.resize(extrema.at.size());
    elimination_.resize(extrema.at.size());
  }
  const double* at = extrema.at.data();
  const double* value = extrema.value.data();
  double* m = curvature_.data();
  double* c = elimination_.data();
  const auto slope = [&](std::size_t j) { return (value[j + 2] - value[j]) / (at[j + 2] - at[j]); };

  m[0] = m[1] = c[0] = c[1] = 0;
  double slope_before[2] = {slope(0), slope(1)};
  for (std::size_t j = 2; j + 2 < count; ++j) {
    const double before = at[j] - at[j - 2], after = at[j + 2] - at[j];
    const double pivot = 1 / (2 * (before + after) - before * c[j - 2]);
    const double slope_after = slope(j);
    m[j] = (6 * (slope_after - slope_before[j % 2]) - before * m[j - 2]) * pivot;
    c[j] = after * pivot;
    slope_before[j % 2] = slope_after;
  }
  m[count - 1] = m[count - 2] = 0;
  for (std::size_t j = count - 2; j-- > 2;) m[j] -= c[j] * m[j + 2];
}

}  // namespace rvbench::analysis
