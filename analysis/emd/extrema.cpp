#include "analysis/emd/extrema.hpp"

#include <algorithm>

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index slice = 1024;  // of a scan: what room is made for at once

}  // namespace

void ExtremaScan::advance(const SiftKernels& kernels, const double* samples, Eigen::Index known,
                          Knots& found) {
  Eigen::Index& next = state_.next;
  if (!has_moved_) {
    while (next + 1 < known && samples[next + 1] == samples[next]) ++next;
    if (next + 1 >= known) return;
    has_moved_ = true;
    state_.is_rising = samples[next + 1] > samples[next];
    state_.plateau_from = ++next;
  }
  while (next + 1 < known) {
    found.make_room(slice);
    found.end += kernels.scan(samples, std::min(known - 1, next + slice), state_,
                              found.at.data() + found.end, found.value.data() + found.end);
  }
}

void ExtremaScan::rebase(Eigen::Index samples) {
  state_.next -= samples;
  state_.plateau_from -= samples;
}

std::size_t count_extrema(const Eigen::VectorXd& x) {
  Knots found;
  ExtremaScan().advance(sift_kernels(), x.data(), x.size(), found);
  return found.size();
}

}  // namespace rvbench::analysis
