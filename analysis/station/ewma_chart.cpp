#include "analysis/station/ewma_chart.hpp"

#include <cmath>

#include "analysis/station/not_finite.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

std::variant<EwmaChart, std::string> ewma_of(const Eigen::Ref<const Eigen::VectorXd>& values,
                                             const ChartBaseline& baseline,
                                             const EwmaSettings& settings) {
  constexpr Require require{"ewma_of"};
  require(values.size() > 0 && values.allFinite(), "no values, or one that is not finite");
  require(baseline.sigma > 0, "the baseline has no scatter");
  require(settings.weight > 0 && settings.weight <= 1 && settings.width > 0,
          "weight or width out of range");
  const double kept = 1 - settings.weight;
  EwmaChart chart;
  chart.means.resize(values.size());
  chart.lower.resize(values.size());
  chart.upper.resize(values.size());
  double mean = baseline.centre;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    mean = settings.weight * values[i] + kept * mean;
    const double begun = 1 - std::pow(kept, 2 * double(i + 1));
    const double reach =
        settings.width * baseline.sigma * std::sqrt(settings.weight / (1 + kept) * begun);
    chart.means[i] = mean;
    chart.lower[i] = baseline.centre - reach;
    chart.upper[i] = baseline.centre + reach;
    if (std::abs(mean - baseline.centre) > reach) chart.out.push_back(i);
  }
  if (!chart.means.allFinite() || !chart.lower.allFinite() || !chart.upper.allFinite()) {
    return not_finite("a weighted mean or its limit");
  }
  return chart;
}

}  // namespace rvbench::analysis
