#include "analysis/emd/sift_chain.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index step = 2048;  // of samples that the sifts take up at once

// Of a slow IMF the cost of its knots is small beside that of its samples, and a knot is long in
// coming.
std::size_t block_of(int imf) {
  return static_cast<std::size_t>(std::max(64 >> std::min(imf, 4), 4));
}

}  // namespace

void SiftChain::begin(int imf) {
  for (Sift& sift : sifts_) sift.begin(block_of(imf));
}

Eigen::Index SiftChain::advance(double* h, Eigen::Index known, bool is_end) {
  for (Sift& sift : sifts_) known = sift.advance(h, known, is_end);
  return known;
}

void SiftChain::rebase(Eigen::Index samples) {
  for (Sift& sift : sifts_) sift.rebase(samples);
}

bool SiftChain::turn_into_imf(Eigen::Ref<Eigen::VectorXd> h, int imf) {
  begin(imf);
  for (Eigen::Index known = 0; known < h.size();) {
    known = std::min(known + step, h.size());
    (void)advance(h.data(), known, known == h.size());
  }
  return extrema() >= least_extrema;
}

// How far the end rule reaches in: beyond it an IMF is within 1 % of its rms of what a longer
// record gives, at 19 of 20 ends. Measured in mean periods of the IMF on white noise and on gear
// signals, 1 to 40 sifts. The power: what an envelope leaves of a slow swing of frequency f goes
// with f⁴, so n sifts see swings down to n^(-1/4) of the IMF's own.
Eigen::Index SiftChain::unreliable_end(Eigen::Index samples) const {
  std::size_t sifted = least_extrema;  // by the last sift that found enough of them
  for (const Sift& sift : sifts_) {
    if (sift.extrema() >= least_extrema) sifted = sift.extrema();
  }
  const auto all = static_cast<double>(samples);
  const double period = 2 * all / static_cast<double>(sifted);
  const double reach = 6 * period * std::pow(static_cast<double>(sifts_.size()), 0.25);
  return static_cast<Eigen::Index>(std::ceil(std::min(reach, all)));
}

}  // namespace rvbench::analysis
