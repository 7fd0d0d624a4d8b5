#include "analysis/evidence/blow_power.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

// Mean square of a train of blows `order` times per turn, at most all that is left. The lines of a
// train, that far apart, are in phase; those of noise are not, and their products cancel.
double blows2(const ResidualEnvelope& channel, double order) {
  const double at = order / channel.resolution;
  const auto line = static_cast<Index>(std::lround(at));
  const auto reach = static_cast<Index>(std::ceil(1 + blow_smear * at));
  const Index n = channel.residual.size();
  double sum = 0;
  for (Index apart = std::max<Index>(3, line - reach); apart <= line + reach; ++apart) {
    if (apart >= n) break;
    const auto low = channel.residual.head(n - apart);
    const auto high = channel.residual.tail(n - apart);
    const double together = std::norm(std::complex<double>(low.dot(high)));
    const double by_noise = low.cwiseAbs2().dot(high.cwiseAbs2());
    sum += together - by_noise;
  }
  const double both_left = channel.left * channel.left;
  return std::min(std::sqrt(std::max(0.0, sum)) / both_left / of_mean_power(1),
                  channel.residual2 / channel.left);
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

std::vector<double> blow_depths2(const std::vector<ResidualEnvelope>& channels,
                                 const Kinematics& kinematics, double order) {
  std::vector<double> depths2;
  for (const ResidualEnvelope& channel : channels) {
    depths2.push_back(channel.lines.power.size() == 0
                          ? not_known
                          : 2 * blows2(channel, order) /
                                reference_mean_square(channel, kinematics));
  }
  return depths2;
}

double median_of_known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return median(std::move(values));
}

}  // namespace rvbench::analysis
