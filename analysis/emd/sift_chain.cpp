#include "analysis/emd/sift_chain.hpp"

#include <algorithm>

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index step = 2048;  // of samples that the sifts take up at once

// Of a slow IMF the cost of its knots is small beside that of its samples, and a knot is long in
// coming.
std::size_t block_of(int imf) {
  return static_cast<std::size_t>(std::max(256 >> std::min(imf, 5), 8));
}

}  // namespace

void SiftChain::begin(std::size_t block) {
  for (Sift& sift : sifts_) sift.begin(block);
}

Eigen::Index SiftChain::advance(double* h, Eigen::Index known, bool is_end) {
  for (Sift& sift : sifts_) known = sift.advance(h, known, is_end);
  return known;
}

void SiftChain::rebase(Eigen::Index samples) {
  for (Sift& sift : sifts_) sift.rebase(samples);
}

bool SiftChain::turn_into_imf(Eigen::Ref<Eigen::VectorXd> h, int imf) {
  begin(block_of(imf));
  for (Eigen::Index known = 0; known < h.size();) {
    known = std::min(known + step, h.size());
    (void)advance(h.data(), known, known == h.size());
  }
  return extrema() >= least_extrema;
}

std::size_t SiftChain::sifted_extrema() const {
  std::size_t sifted = 0;
  for (const Sift& sift : sifts_) {
    if (sift.extrema() >= least_extrema) sifted = sift.extrema();
  }
  return sifted;
}

}  // namespace rvbench::analysis
