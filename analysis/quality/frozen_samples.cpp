#include "analysis/quality/frozen_samples.hpp"

#include <algorithm>
#include <vector>

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest_runs = 100;
constexpr double usual_share = 0.999;  // of the runs
constexpr Eigen::Index much_longer = 10;

}  // namespace

std::optional<FrozenSamples> find_frozen_samples(const Eigen::Ref<const Eigen::VectorXd>& x) {
  std::vector<Eigen::Index> runs;
  FrozenSamples longest;
  for (Eigen::Index first = 0, next = 0; first < x.size(); first = next) {
    while (next < x.size() && x[next] == x[first]) ++next;
    next = std::max(next, first + 1);  // NaN is not even equal to itself
    runs.push_back(next - first);
    if (runs.back() > longest.count) longest = {first, runs.back(), 0};
  }
  if (runs.size() < fewest_runs) return std::nullopt;
  runs.erase(std::ranges::find(runs, longest.count));
  const auto usual = runs.begin() + static_cast<std::ptrdiff_t>(
                                        usual_share * static_cast<double>(runs.size() - 1));
  std::ranges::nth_element(runs, usual);
  longest.usual = *usual;
  if (longest.count <= much_longer * longest.usual) return std::nullopt;
  return longest;
}

}  // namespace rvbench::analysis
