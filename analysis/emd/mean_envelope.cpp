#include "analysis/emd/mean_envelope.hpp"

#include <algorithm>
#include <limits>

namespace rvbench::analysis {
namespace {

constexpr double negligible = 1e-17;
constexpr std::size_t most_spent = 4096;  // knots that are kept though nobody needs them any more
constexpr Eigen::Index unlimited = std::numeric_limits<Eigen::Index>::max();

}  // namespace

void MeanEnvelope::begin(std::size_t block, SplineEnds spline) {
  block_ = block;
  spline_ = spline;
  has_begun_ = false;
  left_[0] = left_[1] = 1;
  done_ = 0;
}

Eigen::Index MeanEnvelope::subtract_settled(const SiftKernels& kernels, double* h, Knots& knots) {
  eliminate(knots);
  while (has_begun_ && finds_block_settled()) {
    settle_block(knots);
    subtract(kernels, h, knots, next_ + block_, unlimited);
    if (next_ > most_spent) drop_spent(knots);
    probed_ = next_ + block_;
    left_[0] = left_[1] = 1;
  }
  return done_;
}

void MeanEnvelope::subtract_rest(const SiftKernels& kernels, double* h, Eigen::Index samples,
                                 Knots& knots) {
  (void)subtract_settled(kernels, h, knots);
  const std::size_t last = knots.end - 2;  // two, one of each envelope
  curvature_[last] = curvature_[last + 1] = 0;
  if (spline_ == SplineEnds::not_a_knot) close_rows_not_a_knot(knots);
  for (std::size_t j = last; j-- > settled_;) {
    curvature_[j] -= elimination_[j] * curvature_[j + 2];
  }
  if (spline_ == SplineEnds::not_a_knot) {
    curve_end(knots);
    if (settled_ == first_) curve_start(knots);
  }
  subtract(kernels, h, knots, last, samples);
}

void MeanEnvelope::make_room(const Knots& knots) {
  if (curvature_.size() >= knots.at.size()) return;
  for (auto* each : {&curvature_, &elimination_, &inverse_width_}) each->resize(knots.at.size());
}

double MeanEnvelope::chord(const Knots& knots, std::size_t j) {
  inverse_width_[j] = 1 / (knots.at[j + 2] - knots.at[j]);
  return (knots.value[j + 2] - knots.value[j]) * inverse_width_[j];
}

bool MeanEnvelope::begins(const Knots& knots) {
  if (has_begun_) return true;
  const bool is_natural = spline_ == SplineEnds::natural;
  if (knots.size() < (is_natural ? 4 : 6)) return false;
  has_begun_ = true;
  first_ = settled_ = knots.first;
  next_ = first_ + 1;
  probed_ = next_ + block_;
  eliminated_ = first_ + 2;
  for (const std::size_t i : {0u, 1u}) {
    curvature_[first_ + i] = elimination_[first_ + i] = taken_[i] = 0;
    chord_[i] = chord(knots, first_ + i);
  }
  if (!is_natural) open_rows_not_a_knot(knots);
  return true;
}

// The first curvature of an envelope is a straight line through the next two: put into the row of
// the second knot.
void MeanEnvelope::open_rows_not_a_knot(const Knots& knots) {
  for (const std::size_t i : {0u, 1u}) {
    const std::size_t j = first_ + 2 + i;
    const double before = knots.at[j] - knots.at[j - 2], after = knots.at[j + 2] - knots.at[j];
    const double ratio = before / after;
    const double pivot = 1 / (2 * (before + after) + before * (1 + ratio));
    const double next = chord(knots, j);
    curvature_[j] = 6 * (next - chord_[i]) * pivot;
    elimination_[j] = (after - before * ratio) * pivot;
    taken_[i] = after * elimination_[j];
    chord_[i] = next;
  }
  eliminated_ = first_ + 4;
}

// Likewise the last one, into the row of the last knot but one. Through three knots goes a
// parabola.
void MeanEnvelope::close_rows_not_a_knot(const Knots& knots) {
  for (const std::size_t j : {knots.end - 4, knots.end - 3}) {
    const double before = knots.at[j] - knots.at[j - 2], after = knots.at[j + 2] - knots.at[j];
    const double step = (knots.value[j + 2] - knots.value[j]) * inverse_width_[j] -
                        (knots.value[j] - knots.value[j - 2]) * inverse_width_[j - 2];
    elimination_[j] = 0;
    if (j - 2 < first_ + 2) {
      curvature_[j] = 2 * step / (before + after);
      continue;
    }
    const double ratio = after / before;
    const double left = before - after * ratio;
    const double pivot = 2 * (before + after) + after * (1 + ratio) - left * elimination_[j - 2];
    curvature_[j] = (6 * step - left * curvature_[j - 2]) / pivot;
  }
}

// Of the outermost knot, from the next two of its envelope.
double MeanEnvelope::curvature_beyond(const Knots& knots, std::size_t outermost, std::size_t next,
                                      std::size_t after) const {
  const double ratio = (knots.at[next] - knots.at[outermost]) / (knots.at[after] - knots.at[next]);
  return curvature_[next] + ratio * (curvature_[next] - curvature_[after]);
}

void MeanEnvelope::curve_start(const Knots& knots) {
  for (const std::size_t j : {first_, first_ + 1}) {
    curvature_[j] = curvature_beyond(knots, j, j + 2, j + 4);
  }
}

void MeanEnvelope::curve_end(const Knots& knots) {
  for (const std::size_t j : {knots.end - 2, knots.end - 1}) {
    const bool is_parabola = j - 4 < first_ + 2;  // whose start has its curvature from here
    curvature_[j] = is_parabola ? curvature_[j - 2] : curvature_beyond(knots, j, j - 2, j - 4);
  }
}

// Every second knot belongs to the same spline: two tridiagonal systems of one shape, solved side
// by side so that the processor can overlap their divisions. A knot takes the next one of its
// envelope: the last two wait.
void MeanEnvelope::eliminate(const Knots& knots) {
  make_room(knots);
  if (!begins(knots)) return;
  const double* at = knots.at.data();
  const double* value = knots.value.data();
  double* m = curvature_.data();
  double* c = elimination_.data();
  double* inverse = inverse_width_.data();
  auto [older, old] = chord_;
  std::size_t j = eliminated_;
  // From one pivot to the next of its envelope leads a division, and no product behind it.
  auto [taken, taken_next] = taken_;
  for (; j + 2 < knots.end; ++j) {
    const double before = at[j] - at[j - 2], after = at[j + 2] - at[j];
    const double pivot = 2 * (before + after) - taken;
    taken = taken_next;
    taken_next = after * after / pivot;
    inverse[j] = 1 / after;
    c[j] = taken_next * inverse[j];
    const double next = (value[j + 2] - value[j]) * inverse[j];
    m[j] = (6 * (next - older) - before * m[j - 2]) * (c[j] * inverse[j]);
    older = old;
    old = next;
  }
  eliminated_ = j;
  chord_[0] = older;
  chord_[1] = old;
  taken_[0] = taken;
  taken_[1] = taken_next;
}

bool MeanEnvelope::finds_block_settled() {
  for (; probed_ + 1 < eliminated_; probed_ += 2) {
    if (left_[0] < negligible && left_[1] < negligible) return true;
    left_[0] *= elimination_[probed_];
    left_[1] *= elimination_[probed_ + 1];
  }
  return false;
}

// Backwards from where it makes no difference what curvature comes next. Beyond the block only the
// next block's own pass is final.
void MeanEnvelope::settle_block(const Knots& knots) {
  const std::size_t end = next_ + block_;
  double* m = curvature_.data();
  const double* c = elimination_.data();
  double a = 0, b = 0;
  for (std::size_t j = probed_; j > end; j -= 2) {
    b = m[j - 1] - c[j - 1] * b;
    a = m[j - 2] - c[j - 2] * a;
  }
  m[end] = a;
  m[end + 1] = b;
  for (std::size_t j = end; j-- > settled_;) m[j] -= c[j] * m[j + 2];
  if (settled_ == first_ && spline_ == SplineEnds::not_a_knot) curve_start(knots);
  settled_ = end + 2;
}

void MeanEnvelope::subtract(const SiftKernels& kernels, double* h, const Knots& knots,
                            std::size_t until, Eigen::Index samples) {
  Cubics mean;
  while (next_ < until) {
    const auto count = std::min<std::size_t>(until - next_, Cubics::most);
    const double* at = knots.at.data() + next_;
    const auto base = static_cast<double>(done_);
    kernels.mean_cubics(at, knots.value.data() + next_, curvature_.data() + next_,
                        inverse_width_.data() + next_, static_cast<int>(count), base, mean);
    next_ += count;
    if (samples != unlimited) {  // knots reach past the last sample, and the last cubic to it
      const int left = static_cast<int>(samples - done_);
      for (std::size_t k = 0; k < count; ++k) mean.end[k] = std::min(mean.end[k], left);
      if (next_ == until) mean.end[count - 1] = left;
    }
    kernels.subtract(h + done_, base, at, mean, static_cast<int>(count));
    done_ += std::max(mean.end[count - 1], 0);
  }
}

void MeanEnvelope::drop_spent(Knots& knots) {
  const std::size_t spent = next_ - 2;
  for (auto* each : {&curvature_, &elimination_, &inverse_width_}) {
    std::copy(each->data() + spent, each->data() + knots.end, each->data());
  }
  for (auto* each : {&eliminated_, &settled_, &next_}) *each -= spent;
  first_ = 0;  // gone: what is left never settles there again
  knots.drop_before(spent);
}

}  // namespace rvbench::analysis
