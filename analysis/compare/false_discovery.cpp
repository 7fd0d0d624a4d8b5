#include "analysis/compare/false_discovery.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rvbench::analysis {

std::vector<double> adjusted_p_values(const std::vector<double>& p_values) {
  std::vector<std::size_t> falling;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    if (!std::isnan(p_values[i])) falling.push_back(i);
  }
  std::ranges::sort(falling,
                    [&](std::size_t a, std::size_t b) { return p_values[a] > p_values[b]; });
  std::vector<double> adjusted = p_values;
  const double asked = static_cast<double>(falling.size());
  double least = 1;
  for (std::size_t k = 0; k < falling.size(); ++k) {
    const double rank = asked - static_cast<double>(k);
    least = std::min(least, asked / rank * p_values[falling[k]]);
    adjusted[falling[k]] = least;
  }
  return adjusted;
}

}  // namespace rvbench::analysis
