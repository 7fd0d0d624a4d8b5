#include "analysis/frf/frf_band.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {

BandLines lines_of(const FrfBand& band, double first_Hz, double step_Hz) {
  constexpr double slack = 1e-3;  // of a step
  const auto line_at = [&](double frequency_Hz) { return (frequency_Hz - first_Hz) / step_Hz; };
  const auto first =
      std::max<Eigen::Index>(0, Eigen::Index(std::ceil(line_at(band.from_Hz) - slack)));
  const auto last = Eigen::Index(std::floor(line_at(band.to_Hz) + slack));
  return {first, last - first + 1};
}

}  // namespace rvbench::analysis
