#include "analysis/indicators/gear_condition.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

std::optional<double> fm0(const Eigen::Ref<const Eigen::VectorXd>& average, Eigen::Index mesh_line,
                          int harmonics) {
  constexpr Require require{"fm0"};
  require(mesh_line >= 1 && harmonics >= 1, "mesh_line and harmonics must be at least 1");
  require(2 * harmonics * mesh_line < average.size(), "a harmonic is not below half the rate");
  const Spectrum spectrum = amplitude_spectrum(average, 1, Window::rectangular);
  double mesh = 0;
  for (Eigen::Index h = 1; h <= harmonics; ++h) mesh += spectrum.amplitude[h * mesh_line];
  // Of no more than rounding there is no ratio.
  const double swing = average.maxCoeff() - average.minCoeff();
  if (!(mesh > 1e-12 * swing)) return std::nullopt;
  return swing / mesh;
}

double fm4(const Eigen::Ref<const Eigen::VectorXd>& difference) { return kurtosis(difference); }

ResidualMoments residual_moments(const Eigen::Ref<const Eigen::VectorXd>& residual) {
  constexpr Require require{"residual_moments"};
  require(residual.size() >= 1 && residual.allFinite(), "needs at least 1 finite sample");
  const Eigen::ArrayXd square = (residual.array() - residual.mean()).square();
  return {square.mean(), square.square().mean()};
}

std::optional<double> na4(const ResidualMoments& now,
                          const std::vector<double>& earlier_variances) {
  constexpr Require require{"na4"};
  const auto is_moment = [](double x) { return std::isfinite(x) && x >= 0; };
  require(is_moment(now.variance) && is_moment(now.fourth_moment) &&
              std::ranges::all_of(earlier_variances, is_moment),
          "moments must be finite and at least 0");
  const double sum =
      std::accumulate(earlier_variances.begin(), earlier_variances.end(), now.variance);
  const double mean = sum / double(earlier_variances.size() + 1);
  if (!(mean > 0)) return std::nullopt;
  return now.fourth_moment / (mean * mean);
}

}  // namespace rvbench::analysis
