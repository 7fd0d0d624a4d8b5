#include "analysis/emd/sift.hpp"

namespace rvbench::analysis {

void Sift::begin(std::size_t block) {
  scan_ = {};
  knots_.clear(EndRule::looks_at);
  mean_.begin(block, rule_.spline);
  extrema_ = 0;
  has_start_ = false;
}

Eigen::Index Sift::advance(double* h, Eigen::Index known, bool is_end) {
  const std::size_t before = knots_.end;
  scan_.advance(*kernels_, h, known, knots_);
  extrema_ += knots_.end - before;
  if (!has_start_) {
    if (extrema_ < EndRule::looks_at && !is_end) return 0;
    if (extrema_ < least_extrema) return known;
    rule_.ends->start(h[0], knots_);
    has_start_ = true;
  }
  if (!is_end) return mean_.subtract_settled(*kernels_, h, knots_);
  rule_.ends->end(h[known - 1], known - 1, extrema_, knots_);
  mean_.subtract_rest(*kernels_, h, known, knots_);
  return known;
}

void Sift::rebase(Eigen::Index samples) {
  scan_.rebase(samples);
  knots_.rebase(static_cast<double>(samples));
  mean_.rebase(samples);
}

}  // namespace rvbench::analysis
