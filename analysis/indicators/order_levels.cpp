#include "analysis/indicators/order_levels.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

// The nearest line; line 0, the mean, is none.
std::optional<Eigen::Index> line_of(const Spectrum& spectrum, double order) {
  const auto line = static_cast<Eigen::Index>(std::lround(order / spectrum.resolution));
  if (line < 1 || line >= spectrum.amplitude.size()) return std::nullopt;
  return line;
}

}  // namespace

std::optional<double> level_at_order(const Spectrum& spectrum, double order, double within) {
  constexpr Require require{"level_at_order"};
  require(std::isfinite(order) && order >= 0, "order must be finite and at least 0");
  require(std::isfinite(within) && within >= 0, "within must be finite and at least 0");
  const std::optional<Eigen::Index> nearest = line_of(spectrum, order);
  if (!nearest) return std::nullopt;
  const double step = spectrum.resolution;
  const auto low = static_cast<Eigen::Index>(std::ceil((order - within) / step));
  const auto high = static_cast<Eigen::Index>(std::floor((order + within) / step));
  const Eigen::Index from = std::clamp<Eigen::Index>(low, 1, *nearest);
  const Eigen::Index to = std::clamp(high, *nearest, spectrum.amplitude.size() - 1);
  return spectrum.amplitude.segment(from, to - from + 1).maxCoeff();
}

std::optional<double> sideband_ratio(const Spectrum& spectrum, double mesh_order, double spacing,
                                     int sidebands) {
  const std::optional<Eigen::Index> mesh = line_of(spectrum, mesh_order);
  if (!mesh || !(spectrum.amplitude[*mesh] > 0)) return std::nullopt;
  double sum = 0;
  for (int k = -sidebands; k <= sidebands; ++k) {
    if (k == 0) continue;
    const std::optional<Eigen::Index> line = line_of(spectrum, mesh_order + k * spacing);
    if (!line || *line == *mesh) return std::nullopt;
    sum += spectrum.amplitude[*line];
  }
  return sum / spectrum.amplitude[*mesh];
}

}  // namespace rvbench::analysis
