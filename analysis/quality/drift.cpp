#include "analysis/quality/drift.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double shortest_block_s = 1;
constexpr Eigen::Index fewest_blocks = 4;
constexpr double far_above = 10;  // rms of the vibration

}  // namespace

std::optional<Drift> find_drift(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                double period_s) {
  if (!(rate_Hz > 0)) throw std::invalid_argument("find_drift: rate_Hz must be positive");
  if (!(period_s > 0)) throw std::invalid_argument("find_drift: period_s must be positive");
  if (!x.allFinite()) throw std::invalid_argument("find_drift: sample not finite");
  const double block = std::ceil(shortest_block_s / period_s) * period_s * rate_Hz;
  const auto count = static_cast<Eigen::Index>(static_cast<double>(x.size()) / block);
  if (count < fewest_blocks || block < 2) return std::nullopt;

  Eigen::VectorXd means(count);
  std::vector<double> swings;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto from = static_cast<Eigen::Index>(static_cast<double>(i) * block);
    const auto part = x.segment(from, static_cast<Eigen::Index>(block));
    means[i] = part.mean();
    swings.push_back(std::sqrt((part.array() - means[i]).square().mean()));
  }
  const Drift drift{means.maxCoeff() - means.minCoeff(), median(swings)};
  if (!(drift.change > far_above * drift.vibration)) return std::nullopt;
  return drift;
}

}  // namespace rvbench::analysis
