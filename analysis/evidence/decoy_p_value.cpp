#include "analysis/evidence/decoy_p_value.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double gaussian_sd = 1.4826;  // of a median deviation of 1
constexpr double efficiency = 0.37;     // of the median deviation
constexpr double least_p = 1e-300;

}  // namespace

double decoy_p_value(double log_ratio, const Eigen::Ref<const Eigen::VectorXd>& decoys,
                     double lines_per_decoy_line) {
  if (decoys.size() < 2) throw std::invalid_argument("decoy_p_value: 2 decoys are needed");
  const double lines = median({decoys.begin(), decoys.end()});
  if (!(lines > 0) || !(log_ratio > 0)) return 1;
  std::vector<double> roots;
  for (const double decoy : decoys) roots.push_back(std::cbrt(decoy));
  const double centre = median(roots);
  for (double& root : roots) root = std::abs(root - centre);
  const double independent = std::cbrt(lines) / (3 * std::sqrt(lines));
  const double spread = std::max(gaussian_sd * median(std::move(roots)), independent);
  const double freedom = efficiency * static_cast<double>(decoys.size() - 1);
  const double of_centre_too = spread * std::sqrt(1 + lines_per_decoy_line);
  const double t = (std::cbrt(log_ratio) - centre) / of_centre_too;
  const double tail = 0.5 * t_p_value(t, freedom);
  return std::clamp(t > 0 ? tail : 1 - tail, least_p, 1.0);
}

}  // namespace rvbench::analysis
