#include "analysis/evidence/blow_lines.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/evidence/blow_power.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

// A channel weighs the more, the louder it would hear blows that are just bad over its noise. The
// weights are scaled: their sum of −ln p scatters as that of Σ channels of equal weight.
std::vector<double> weights_of(const std::vector<ResidualEnvelope>& channels,
                               const Kinematics& kinematics) {
  constexpr double just_bad = 0.1;
  std::vector<double> weights;
  double sum = 0, squares = 0;
  for (const ResidualEnvelope& channel : channels) {
    weights.push_back(0);
    if (channel.lines.power.size() == 0 || !(channel.residual2 > 0)) continue;
    const double depth = of_mean_power(1) * swing_by(just_bad, channel, kinematics);
    const double over = depth * depth / channel.lines.floor.mean();
    weights.back() = over / (1 + over);
    sum += weights.back();
    squares += weights.back() * weights.back();
  }
  for (double& weight : weights) weight *= squares > 0 ? sum / squares : 0;
  return weights;
}

}  // namespace

BlowLines::BlowLines(const std::vector<ResidualEnvelope>& channels, const Kinematics& kinematics)
    : weights_(weights_of(channels, kinematics)) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const ResidualEnvelope& channel = channels[c];
    if (channel.lines.power.size() == 0) continue;
    if (sum_.size() == 0) {
      sum_ = Eigen::VectorXd::Zero(channel.lines.power.size());
      resolution_ = channel.resolution;
      locked_ = channel.locked;
    }
    if (channel.lines.power.size() != sum_.size()) {
      weights_[c] = 0;
      continue;
    }
    channels_ += weights_[c];
    for (Index i = 0; i < sum_.size(); ++i) sum_[i] += weights_[c] * channel.lines.log_ratio(i);
  }
  for (Index i = 0; i < sum_.size(); ++i) {
    if (i < 3 || locked_[static_cast<std::size_t>(i)]) sum_[i] = channels_;
  }
  spread();
}

void BlowLines::take(double order) {
  const double line = order / resolution_;
  const double reach = 2 + blow_smear * line;
  for (auto i = static_cast<Index>(line - reach); i <= static_cast<Index>(line + reach); ++i) {
    if (i >= 0 && i < sum_.size()) sum_[i] = channels_;
  }
}

void BlowLines::spread() {
  highest_ = sum_;
  for (Index i = 0; i < sum_.size(); ++i) {
    const auto reach = static_cast<Index>(blow_smear * static_cast<double>(i));
    const Index from = std::max<Index>(0, i - reach);
    highest_[i] = sum_.segment(from, std::min(sum_.size(), i + reach + 1) - from).maxCoeff();
  }
}

double BlowLines::read(const Eigen::VectorXd& lines, double order) const {
  const auto line = static_cast<Index>(std::lround(order / resolution_));
  return line > 2 && line < lines.size() ? lines[line] : channels_;
}

}  // namespace rvbench::analysis
