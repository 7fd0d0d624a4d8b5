#include "bench/population.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rvbench::bench {
namespace {

constexpr std::size_t most_limited = 3;
constexpr std::size_t most_shown = 4;
constexpr double sigma_per_mad = 1.4826;  // of a normal distribution

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::vector<double> all_of(const Standing& standing) {
  std::vector<double> values = standing.passed;
  values.insert(values.end(), standing.failed.begin(), standing.failed.end());
  return values;
}

Standing standing_of(const UnitNumber& number, std::size_t at,
                     const std::vector<EarlierUnit>& earlier) {
  Standing standing{number, {}, {}};
  for (const EarlierUnit& unit : earlier) {
    const double value = unit.values[at];
    if (!std::isfinite(value)) continue;
    (unit.passed ? standing.passed : standing.failed).push_back(value);
    const bool better = number.worst_is_least ? value > number.value : value < number.value;
    standing.better += better ? 1 : 0;
  }
  if (standing.units() > 0) standing.median = median_of(all_of(standing));
  return standing;
}

// How far it is out on the bad side, in standard deviations.
double farness_of(const Standing& standing) {
  std::vector<double> distances = all_of(standing);
  for (double& value : distances) value = std::abs(value - standing.median);
  const double sigma = sigma_per_mad * median_of(distances);
  const double off = standing.number.worst_is_least ? standing.median - standing.number.value
                                                    : standing.number.value - standing.median;
  if (off == 0) return 0;
  return sigma > 0 ? off / sigma : std::copysign(std::numeric_limits<double>::infinity(), off);
}

}  // namespace

Population population_of(const std::vector<UnitNumber>& numbers,
                         const std::vector<EarlierUnit>& earlier) {
  Population population;
  for (const EarlierUnit& unit : earlier) {
    if (unit.values.size() != numbers.size()) {
      throw std::invalid_argument("population_of: " + unit.serial + " has other numbers");
    }
    (unit.passed ? population.passed : population.failed) += 1;
  }
  std::vector<Standing> limited, others;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    Standing standing = standing_of(numbers[i], i, earlier);
    if (standing.units() < least_population) continue;
    (std::isfinite(numbers[i].limit) ? limited : others).push_back(std::move(standing));
  }
  const auto share = [](const Standing& one) { return share_of_limit(one.number); };
  std::ranges::stable_sort(limited, std::greater{}, share);
  std::ranges::stable_sort(others, std::greater{}, farness_of);
  limited.resize(std::min(limited.size(), most_limited));
  others.resize(std::min(others.size(), most_shown - limited.size()));
  population.standings = std::move(limited);
  for (Standing& standing : others) population.standings.push_back(std::move(standing));
  return population;
}

}  // namespace rvbench::bench
