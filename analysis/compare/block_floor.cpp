#include "analysis/compare/block_floor.hpp"

#include <numbers>
#include <unsupported/Eigen/SpecialFunctions>

namespace rvbench::analysis {

double noise_median(double blocks) {
  double low = std::numbers::ln2, high = 1;  // the mean lies above the median
  if (blocks <= 1) return low;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (Eigen::numext::igamma(blocks, blocks * middle) < 0.5 ? low : high) = middle;
  }
  return high;
}

LineFloor block_floor(const Spectrum& spectrum, Eigen::Index locked_every, double blocks) {
  LineFloor result = line_floor(spectrum, locked_every);
  result.floor *= std::numbers::ln2 / noise_median(blocks);
  return result;
}

}  // namespace rvbench::analysis
