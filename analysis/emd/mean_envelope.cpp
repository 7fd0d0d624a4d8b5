#include "analysis/emd/mean_envelope.hpp"

#include <algorithm>

namespace rvbench::analysis {
namespace {

// value + slope·u + curve·u² + twist·u³
struct Cubic {
  double value, slope, curve, twist;

  // The same polynomial about a point s later.
  Cubic moved(double s) const {
    return {value + s * (slope + s * (curve + s * twist)), slope + s * (2 * curve + 3 * s * twist),
            curve + 3 * s * twist, twist};
  }
};

Cubic mean(const Cubic& a, const Cubic& b) {
  return {0.5 * (a.value + b.value), 0.5 * (a.slope + b.slope), 0.5 * (a.curve + b.curve),
          0.5 * (a.twist + b.twist)};
}

// The first sample at or after an extremum, which lies on a sample or half-way between two. Up to
// sample 0 any answer that is not positive will do. (std::ceil is a call on older processors.)
Eigen::Index sample_from(double at) { return (static_cast<Eigen::Index>(2 * at) + 1) / 2; }

// Not in 64 bits: vector units convert only 32-bit integers.
void subtract(const Cubic& cubic, double u_first, double* samples, int count) {
  for (int i = 0; i < count; ++i) {
    const double u = u_first + i;
    samples[i] -= cubic.value + u * (cubic.slope + u * (cubic.curve + u * cubic.twist));
  }
}

}  // namespace

void MeanEnvelope::subtract_from(Eigen::Ref<Eigen::VectorXd> h, const Extrema& extrema) {
  solve(extrema);
  const double* at = extrema.at.data();
  const double* value = extrema.value.data();
  // The spline through knots j and j + 2, about knot j.
  const auto segment = [&](std::size_t j) {
    const double width = at[j + 2] - at[j];
    const double chord = (value[j + 2] - value[j]) * inverse_width_[j];
    const double m = curvature_[j], m_next = curvature_[j + 2];
    return Cubic{value[j], chord - width * (2 * m + m_next) * (1. / 6), 0.5 * m,
                 (m_next - m) * inverse_width_[j] * (1. / 6)};
  };

  Eigen::Index i = 0;
  Cubic other = segment(0);
  for (std::size_t j = 1; j + 2 < extrema.count; ++j) {
    const Cubic own = segment(j);
    const Cubic both = mean(own, other.moved(at[j] - at[j - 1]));
    other = own;
    const bool is_last = j + 3 == extrema.count;
    const Eigen::Index end = is_last ? h.size() : std::min(h.size(), sample_from(at[j + 1]));
    if (end <= i) continue;
    subtract(both, static_cast<double>(i) - at[j], h.data() + i, static_cast<int>(end - i));
    i = end;
  }
}

// Every second knot belongs to the same spline: two tridiagonal systems of one shape, solved side
// by side so that the processor can overlap their divisions.
void MeanEnvelope::solve(const Extrema& extrema) {
  const std::size_t count = extrema.count;
  if (curvature_.size() < count) {
    for (auto* each : {&curvature_, &elimination_, &inverse_width_})
      each->resize(extrema.at.size());
  }
  const double* at = extrema.at.data();
  const double* value = extrema.value.data();
  double* m = curvature_.data();
  double* c = elimination_.data();
  double* inverse = inverse_width_.data();
  const auto chord = [&](std::size_t j) {
    inverse[j] = 1 / (at[j + 2] - at[j]);
    return (value[j + 2] - value[j]) * inverse[j];
  };

  m[0] = m[1] = c[0] = c[1] = 0;
  double older = chord(0), old = chord(1);  // of the two envelopes in turn
  for (std::size_t j = 2; j + 2 < count; ++j) {
    const double before = at[j] - at[j - 2], across = at[j + 2] - at[j - 2];
    const double pivot = 1 / (2 * across - before * c[j - 2]);
    const double next = chord(j);
    m[j] = (6 * (next - older) - before * m[j - 2]) * pivot;
    c[j] = (across - before) * pivot;
    older = old;
    old = next;
  }
  m[count - 1] = m[count - 2] = 0;
  for (std::size_t j = count - 2; j-- > 2;) m[j] -= c[j] * m[j + 2];
}

}  // namespace rvbench::analysis
