#include "analysis/evidence/blow_power.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

// Mean square of a train of blows `order` times per turn, at most all that is left, and its
// variance by noise. The lines of a train, that far apart, are in phase; those of noise are not,
// and their products cancel.
struct BlowPower {
  double mean2 = 0;
  double variance = 0;
};

BlowPower blow_power(const ResidualEnvelope& channel, double order) {
  const double at = order / channel.resolution;
  const auto line = static_cast<Index>(std::lround(at));
  const auto reach = static_cast<Index>(std::ceil(1 + blow_smear * at));
  const Index n = channel.residual.size();
  double sum = 0, variance = 0;
  for (Index apart = std::max<Index>(3, line - reach); apart <= line + reach; ++apart) {
    if (apart >= n) break;
    const auto low = channel.residual.head(n - apart);
    const auto high = channel.residual.tail(n - apart);
    const double together = std::norm(std::complex<double>(low.dot(high)));
    const double by_noise = low.cwiseAbs2().dot(high.cwiseAbs2());
    sum += together - by_noise;
    // |s + n|² of complex noise n varies by 2·|s|²·|n|² + |n|⁴ round |s|² + |n|².
    variance += by_noise * (2 * std::max(0.0, together - by_noise) + by_noise);
  }
  if (!(sum > 0)) return {};
  const double scale = channel.left * channel.left * of_mean_power(1);
  return {std::min(std::sqrt(sum) / scale, channel.residual2 / channel.left),
          variance / (4 * sum) / (scale * scale)};
}

}  // namespace

double of_mean_power(int harmonic) {
  constexpr std::array shares{0.33, 0.16, 0.10, 0.07};
  static_assert(shares.size() == blow_harmonics);
  return shares[static_cast<std::size_t>(harmonic - 1)];
}

double reference_mean_square(const ResidualEnvelope& channel, const Kinematics& kinematics) {
  const double all = channel.gears2 + channel.residual2;
  return std::max(kinematics.meshes.empty() ? all : channel.gears2, 1e-12 * all);
}

double swing_by(double severity, const ResidualEnvelope& channel, const Kinematics& kinematics) {
  const double blows =
      channel.left * severity * severity * reference_mean_square(channel, kinematics) / 2;
  return 2 * blows / (blows + channel.residual2);
}

std::vector<BlowDepth> blow_depths(const std::vector<ResidualEnvelope>& channels,
                                   const Kinematics& kinematics, double order) {
  std::vector<BlowDepth> depths;
  for (const ResidualEnvelope& channel : channels) {
    BlowDepth& depth = depths.emplace_back();
    if (channel.lines.power.size() == 0) continue;
    const BlowPower power = blow_power(channel, order);
    const double to_depth2 = 2 / reference_mean_square(channel, kinematics);
    depth = {to_depth2 * power.mean2, to_depth2 * to_depth2 * power.variance};
  }
  return depths;
}

double median_depth2(const std::vector<BlowDepth>& depths) {
  std::vector<double> known;
  for (const BlowDepth& depth : depths) known.push_back(depth.depth2);
  return median_of_known(std::move(known));
}

double swing_at(const ResidualEnvelope& channel, double order) {
  const double at = order / channel.resolution;
  const auto reach = static_cast<Index>(std::ceil(1 + blow_smear * at));
  double swing2 = 0;
  for (Index line = std::lround(at) - reach; line <= std::lround(at) + reach; ++line) {
    if (line < 0 || line >= channel.lines.power.size()) continue;
    if (channel.locked[static_cast<std::size_t>(line)]) continue;
    swing2 = std::max(swing2, channel.lines.power[line] - channel.lines.floor[line]);
  }
  return std::sqrt(swing2);
}

double median_of_known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return median(std::move(values));
}

}  // namespace rvbench::analysis
