#include "analysis/compare/spectral_peaks.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/compare/line_level.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {

using Index = Eigen::Index;

SpectralPeaks::SpectralPeaks(const Spectrum& spectrum, const LineFloor& floor, double blocks)
    : spectrum_(spectrum),
      floor_(floor),
      blocks_(blocks),
      log_ratio_((floor.power.array() / floor.floor.array()).max(1).log()) {}

Index SpectralPeaks::line_of(double order) const {
  return static_cast<Index>(std::lround(order / spectrum_.resolution));
}

std::optional<Peak> SpectralPeaks::at(double order, double smear) const {
  const auto level =
      line_level(spectrum_, floor_, blocks_, order, spectrum_.resolution, smear * order);
  if (!level || level->p_value > seen_p) return std::nullopt;
  Index highest = line_of(order);
  for (const Index line : {highest - 1, highest + 1}) {
    if (floor_.power[line] > floor_.power[highest]) highest = line;
  }
  constexpr auto hann = static_cast<Index>(lines_to_part) - 1;
  const auto reach = std::max(hann, static_cast<Index>(smear * static_cast<double>(highest)));
  Peak peak{highest, highest};
  while (peak.from > std::max<Index>(highest - reach, 0) && stands_out(peak.from - 1)) {
    --peak.from;
  }
  while (peak.to < std::min(highest + reach, size() - 1) && stands_out(peak.to + 1)) ++peak.to;
  peak.from = std::max<Index>(std::min(peak.from, highest - hann), 0);
  peak.to = std::min(std::max(peak.to, highest + hann), size() - 1);
  return peak;
}

bool SpectralPeaks::stands_out(Index line) const {
  return line_p_value(blocks_ * floor_.power[line] / floor_.floor[line], blocks_,
                      blocks_ * floor_.floor_lines[line]) <= seen_p;
}

}  // namespace rvbench::analysis
