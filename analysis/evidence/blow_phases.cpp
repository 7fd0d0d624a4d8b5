#include "analysis/evidence/blow_phases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/fft.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

double excess_over_random_phases(const Eigen::VectorXcd& turn_lines,
                                 const std::vector<int>& harmonics) {
  const Index highest = std::ranges::max(harmonics);
  // The fourth power of the sum reaches four times its highest line.
  const Index samples = next_fast_length(4 * highest + 2);
  Eigen::VectorXcd kept = Eigen::VectorXcd::Zero(samples / 2 + 1);
  double power = 0, fourth = 0;
  for (const int h : harmonics) {
    kept[h] = turn_lines[h];
    const double a2 = std::norm(turn_lines[h]);
    power += a2;
    fourth += a2 * a2;
  }
  if (!(power > 0)) return not_known;
  const Eigen::ArrayXd x2 = inverse_fft(std::move(kept), samples).array().square();
  const double kurtosis = x2.square().mean() / std::pow(x2.mean(), 2);
  return kurtosis - (3 - 1.5 * fourth / (power * power));
}

}  // namespace

std::vector<double> blow_phases(const OrderLines& lines, const GearPlaces& places,
                                const Kinematics& kinematics) {
  std::vector<double> excess(places.parts.size(), not_known);
  for (std::size_t s = 0; s < places.parts.size(); ++s) {
    const Signature& part = kinematics.signatures[s];
    if (places.parts[s].turn_lines.empty()) continue;
    std::vector<int> harmonics = places.parts[s].turn_lines;
    const OrderLines::TurnLines turn = lines.turn_lines(part.turn);
    std::erase_if(harmonics, [&](int h) { return 2 * h >= turn.samples; });
    if (std::ssize(harmonics) < fewest_phases) continue;
    excess[s] = excess_over_random_phases(turn.lines, harmonics);
  }
  return excess;
}

}  // namespace rvbench::analysis
