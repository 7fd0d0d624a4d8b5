#include "analysis/envelope/squared_envelope_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/fft.hpp"
#include "analysis/squared_envelope.hpp"

namespace rvbench::analysis {
namespace {

// Σ S[k + a]·S[k] over the band, where S is the noise floor of x: how many products of spectral
// lines a line of the squared envelope is the sum of, and of which size. 1 for a = 0.
Eigen::VectorXd products_in_band(const Eigen::VectorXd& floor, Eigen::Index from,
                                 Eigen::Index size) {
  const Eigen::Index length = next_fast_length(2 * size);
  Eigen::VectorXd band = Eigen::VectorXd::Zero(length);
  band.head(size) = floor.segment(from, size);
  const Eigen::VectorXcd power = fft(band).cwiseAbs2().cast<std::complex<double>>();
  Eigen::VectorXd products = inverse_fft(power, length).head(size);
  return products / products[0];
}

}  // namespace

TestedSpectrum squared_envelope_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate,
                                         double from, double to) {
  BandVibration band = band_vibration(x, rate, from, to, 1);
  const double step = band.depth.resolution;
  const auto first = std::max<Eigen::Index>(1, std::lround(std::ceil(from / step)));
  const auto end = std::min<Eigen::Index>(band.depth.amplitude.size(), std::lround(to / step));
  const Eigen::Index size = std::max<Eigen::Index>(1, end - first);

  const LineFloor floor = line_floor(amplitude_spectrum(x, rate, Window::hann), 0);
  const Eigen::VectorXd products = products_in_band(floor.floor, first, size);
  Eigen::VectorXd shape = Eigen::VectorXd::Constant(band.depth.amplitude.size(), 1e-9);
  shape.head(size) = products.cwiseMax(1e-9);
  return tested_against_floor(std::move(band.depth), size - too_few_products, shape);
}

}  // namespace rvbench::analysis
