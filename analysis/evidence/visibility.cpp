#include "analysis/evidence/visibility.hpp"

#include <cmath>
#include <limits>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/decoy_p_value.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double lowest = 1e-4;
constexpr double highest = 1e4;

// Where a rising function crosses 0, on a logarithmic scale.
double crossing(double low, double high, const std::function<bool(double)>& is_above) {
  while (high / low > 1.01) {
    const double middle = std::sqrt(low * high);
    (is_above(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

double visible_sum(const Eigen::Ref<const Eigen::VectorXd>& decoys) {
  const double centre = median({decoys.begin(), decoys.end()});
  if (!(centre > 0)) return std::numeric_limits<double>::infinity();
  const double significant = crossing(
      centre, 1e3 * centre, [&](double sum) { return decoy_p_value(sum, decoys) < significant_p; });
  return significant + 1.28 * std::sqrt(significant);
}

double severity_reaching(double asked, const std::function<double(double severity)>& sum) {
  if (!(sum(highest) > asked)) return std::numeric_limits<double>::infinity();
  return crossing(lowest, highest, [&](double severity) { return sum(severity) > asked; });
}

}  // namespace rvbench::analysis
