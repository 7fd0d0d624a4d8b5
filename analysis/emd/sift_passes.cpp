#include "analysis/emd/sift_passes.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t block = 64;  // of knots that are settled at once

// The upper envelope stays, the lower one is turned over: their mean is the amplitude.
void turn_minima_over(Knots& knots) {
  const bool starts_low = knots.value[knots.first] < knots.value[knots.first + 1];
  for (std::size_t j = knots.first + (starts_low ? 0 : 1); j < knots.end; j += 2) {
    knots.value[j] = -knots.value[j];
  }
}

}  // namespace

bool SiftPasses::turn_into_imf(Eigen::Ref<Eigen::VectorXd> h) {
  Eigen::VectorXd sifted = h;
  sifts_ = 0;
  if (!draw_envelopes(sifted)) return false;
  extrema_ = found_;
  const auto stopping = stopping_->begin();
  while (sifts_ < most_sifts_ && !stopping->is_imf({sifted, mean_, amplitude_})) {
    extrema_ = found_;
    sifted -= mean_;
    ++sifts_;
    if (!draw_envelopes(sifted)) break;
  }
  h = sifted;
  return true;
}

bool SiftPasses::draw_envelopes(const Eigen::VectorXd& h) {
  const SiftKernels& kernels = sift_kernels();
  const auto mean_through = [&](Knots& knots, Eigen::VectorXd& mean) {
    mean.setZero(h.size());
    envelope_.begin(block, rule_.spline);
    envelope_.subtract_rest(kernels, mean.data(), h.size(), knots);
    mean = -mean;
  };
  knots_.clear(EndRule::looks_at);
  ExtremaScan().advance(kernels, h.data(), h.size(), knots_);
  if (knots_.size() < least_extrema) return false;
  found_ = knots_.size();
  rule_.ends->start(h[0], knots_);
  rule_.ends->end(h[h.size() - 1], h.size() - 1, found_, knots_);
  Knots turned = knots_;
  turn_minima_over(turned);
  mean_through(knots_, mean_);
  mean_through(turned, amplitude_);
  return true;
}

}  // namespace rvbench::analysis
