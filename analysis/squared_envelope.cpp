#include "analysis/squared_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analysis/envelope/band_pass.hpp"
#include "analysis/fft.hpp"
#include "analysis/hilbert.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index noise_lines = 20;  // to each side, that tell of the noise

}  // namespace

BandVibration band_vibration(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                             double from_Hz, double to_Hz, Eigen::Index parts) {
  if (parts < 1) throw std::invalid_argument("band_vibration: parts must be at least 1");
  Eigen::VectorXcd lines = band_lines(x, rate_Hz, from_Hz, to_Hz);
  const auto n = static_cast<double>(x.size());
  BandVibration vibration{Eigen::VectorXd::Zero(parts), {}};
  for (Eigen::Index k = 1; k < lines.size(); ++k) {
    const double f_Hz = double(k) * rate_Hz / n;
    if (f_Hz < from_Hz || f_Hz >= to_Hz) continue;
    const auto part =
        static_cast<Eigen::Index>((f_Hz - from_Hz) / (to_Hz - from_Hz) * double(parts));
    vibration.mean_square[std::min(part, parts - 1)] += 2 * std::norm(lines[k]) / (n * n);
  }
  const Eigen::VectorXd power = envelope(inverse_fft(std::move(lines), x.size())).cwiseAbs2();
  vibration.depth = amplitude_spectrum(power, rate_Hz, Window::hann);
  const double mean = vibration.depth.amplitude[0];
  if (mean > 0) vibration.depth.amplitude /= mean;
  return vibration;
}

DepthNear depth_near(const Spectrum& depth, double frequency_Hz, double within_Hz) {
  const Eigen::Index last = depth.amplitude.size() - 1;
  const auto line = [&](double f_Hz) {
    return std::clamp<Eigen::Index>(std::lround(f_Hz / depth.resolution), 1, last);
  };
  const Eigen::Index at = line(frequency_Hz);
  const Eigen::Index low =
      std::min(line(frequency_Hz - within_Hz), std::max<Eigen::Index>(at - 1, 1));
  const Eigen::Index high = std::max(line(frequency_Hz + within_Hz), std::min(at + 1, last));
  const Eigen::Index first = std::max<Eigen::Index>(low - noise_lines, 1);
  std::vector<double> beside;
  for (Eigen::Index k = first; k <= std::min(high + noise_lines, last); ++k) {
    if (k < low || k > high) beside.push_back(depth.amplitude[k]);
  }
  if (beside.empty()) beside.push_back(0);
  std::ranges::nth_element(beside, beside.begin() + std::ptrdiff_t(beside.size() / 2));
  const double sigma = beside[beside.size() / 2] / std::sqrt(2 * std::numbers::ln2);
  const double independent = std::max(1.0, double(high - low + 1) / lines_per_hann_line);
  return {depth.amplitude.segment(low, high - low + 1).maxCoeff(),
          sigma * std::sqrt(2 * (std::log(independent) + 1)), sigma};
}

}  // namespace rvbench::analysis
