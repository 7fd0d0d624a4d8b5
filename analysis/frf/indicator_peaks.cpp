#include "analysis/frf/indicator_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rvbench::analysis {

namespace {

constexpr Eigen::Index same_peak = 2;  // lines

// Lines to walk from a peak until the curve is below `floor`; 0 if it rises above the peak before.
// The end of the curve counts as a fall where one was under way.
Eigen::Index lines_to_fall(const Eigen::VectorXd& curve, Eigen::Index peak, Eigen::Index step,
                           double floor) {
  for (Eigen::Index i = peak + step; i >= 0 && i < curve.size(); i += step) {
    if (!(curve[i] <= curve[peak])) return 0;
    if (curve[i] <= floor) return std::abs(i - peak);
  }
  return 0;
}

}  // namespace

std::vector<IndicatorPeak> indicator_peaks(const Eigen::MatrixXd& indicator, double least_dB) {
  const double fall = std::pow(10, -least_dB / 20);
  std::vector<IndicatorPeak> peaks;
  for (Eigen::Index c = 0; c < indicator.cols(); ++c) {
    const Eigen::VectorXd curve = indicator.col(c);
    for (Eigen::Index k = 1; k + 1 < curve.size(); ++k) {
      if (!(curve[k] > curve[k - 1] && curve[k] >= curve[k + 1])) continue;
      if (lines_to_fall(curve, k, -1, fall * curve[k]) == 0) continue;
      if (lines_to_fall(curve, k, 1, fall * curve[k]) == 0) continue;
      const bool on_largest = std::ranges::any_of(peaks, [&](const IndicatorPeak& peak) {
        return peak.curve == 0 && std::abs(peak.line - k) <= same_peak;
      });
      if (c > 0 && !on_largest) continue;
      const double half_power = curve[k] / std::sqrt(2.0);
      const Eigen::Index left = lines_to_fall(curve, k, -1, half_power);
      const Eigen::Index right = lines_to_fall(curve, k, 1, half_power);
      const Eigen::Index known = left > 0 && right > 0 ? left + right : 2 * std::max(left, right);
      peaks.push_back({k, c, std::max<Eigen::Index>(known, 1)});
    }
  }
  return peaks;
}

}  // namespace rvbench::analysis
