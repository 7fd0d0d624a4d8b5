#include "analysis/station/robust_limit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "analysis/station/distributions.hpp"
#include "analysis/station/not_finite.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double normal_per_mad = 1.482602218505602;  // 1/Φ⁻¹(3/4)
constexpr double far = 3;                             // robust deviations
constexpr int draws = 20000;
constexpr std::size_t most_simulated = 100;

struct RobustSpread {
  double median = 0;
  double mad = 0;

  double deviation() const { return normal_per_mad * mad; }
  bool holds(double value) const { return std::abs(value - median) <= far * deviation(); }
};

RobustSpread spread_of(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> off;
  off.reserve(values.size());
  for (const double value : values) off.push_back(std::abs(value - middle));
  return {middle, median(std::move(off))};
}

// Of those that are like most.
RobustSpread spread_of_the_alike(const std::vector<double>& values) {
  const RobustSpread all = spread_of(values);
  std::vector<double> alike;
  std::ranges::copy_if(values, std::back_inserter(alike), [&](double v) { return all.holds(v); });
  return alike.size() == values.size() ? all : spread_of(alike);
}

double simulated_factor(std::size_t units, double z, double confidence) {
  std::mt19937_64 engine(20);
  std::normal_distribution<double> normal;
  std::vector<double> needed, sample(units);
  for (int draw = 0; draw < draws; ++draw) {
    for (double& value : sample) value = normal(engine);
    const RobustSpread spread = spread_of_the_alike(sample);
    needed.push_back((z - spread.median) / spread.deviation());
  }
  const auto at = needed.begin() + static_cast<std::ptrdiff_t>(confidence * draws);
  std::ranges::nth_element(needed, at);
  return *at;
}

}  // namespace

std::string too_few_units(std::size_t units) {
  if (units >= least_units_of_a_limit) return "";
  return std::to_string(units) + (units == 1 ? " unit" : " units") + ", and a limit takes " +
         std::to_string(least_units_of_a_limit);
}

double robust_tolerance_factor(std::size_t units, const Coverage& coverage) {
  constexpr Require require{"robust_tolerance_factor"};
  require(units >= least_units_of_a_limit, too_few_units(units));
  require(coverage.content > 0.5 && coverage.content < 1, "the content is a share above one half");
  require(coverage.confidence > 0.5 && coverage.confidence < 1,
          "the confidence is a share above one half");
  const double z = normal_quantile(coverage.content);
  const std::size_t simulated = std::min(units, most_simulated);
  const double excess = simulated_factor(simulated, z, coverage.confidence) - z;
  return z + excess * std::sqrt(static_cast<double>(simulated) / static_cast<double>(units));
}

std::variant<RobustLimit, std::string> robust_limit(const std::vector<double>& values,
                                                    LimitSide side, double factor) {
  constexpr Require require{"robust_limit"};
  require(std::ranges::all_of(values, [](double v) { return std::isfinite(v); }),
          "a value is not finite");
  if (std::string few = too_few_units(values.size()); !few.empty()) return few;
  const RobustSpread all = spread_of(values);
  if (!are_finite({all.median, all.deviation()})) return not_finite("the spread of the units");
  const RobustSpread alike = spread_of_the_alike(values);
  if (!(alike.mad > 0)) {
    return "half of the " + std::to_string(values.size()) +
           " units have one value: it is too coarse to learn a limit from";
  }
  RobustLimit learnt;
  learnt.units = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!all.holds(values[i])) learnt.set_aside.push_back(i);
  }
  learnt.median = alike.median;
  learnt.mad = alike.mad;
  learnt.factor = factor;
  learnt.limit = alike.median + (side == LimitSide::max ? factor : -factor) * alike.deviation();
  if (!are_finite({learnt.limit})) return not_finite("the limit");
  return learnt;
}

}  // namespace rvbench::analysis
