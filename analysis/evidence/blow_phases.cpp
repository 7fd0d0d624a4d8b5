#include "analysis/evidence/blow_phases.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <random>
#include <utility>

#include "analysis/fft.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr int draws = 16;  // of random phases: their spread is known to a sixth

double kurtosis_of(Eigen::VectorXcd lines, Index samples) {
  const Eigen::ArrayXd x2 = inverse_fft(std::move(lines), samples).array().square();
  return x2.square().mean() / std::pow(x2.mean(), 2);
}

// How far the kurtosis lies above that of random phases, in standard deviations of theirs.
double over_random_phases(const Eigen::VectorXcd& turn_lines, const std::vector<int>& harmonics) {
  const Index highest = std::ranges::max(harmonics);
  // The fourth power of the sum reaches four times its highest line.
  const Index samples = next_fast_length(4 * highest + 2);
  Eigen::VectorXcd kept = Eigen::VectorXcd::Zero(samples / 2 + 1);
  std::vector<double> amplitudes;
  double power = 0, fourth = 0;
  for (const int h : harmonics) {
    kept[h] = turn_lines[h];
    amplitudes.push_back(std::abs(turn_lines[h]));
    const double a2 = std::norm(turn_lines[h]);
    power += a2;
    fourth += a2 * a2;
  }
  if (!(power > 0)) return not_known;
  const double of_random = 3 - 1.5 * fourth / (power * power);
  const double excess = kurtosis_of(kept, samples) - of_random;
  std::mt19937_64 engine(20261130);  // the same phases in each record
  std::uniform_real_distribution<double> phase_rad(0, units::two_pi);
  double squares = 0;
  for (int draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < harmonics.size(); ++i) {
      kept[harmonics[i]] = std::polar(amplitudes[i], phase_rad(engine));
    }
    squares += std::pow(kurtosis_of(kept, samples) - of_random, 2);
  }
  return squares > 0 ? excess / std::sqrt(squares / draws) : not_known;
}

}  // namespace

std::vector<double> blow_phases(const OrderLines& lines, const GearPlaces& places,
                                const Kinematics& kinematics) {
  std::vector<double> over(places.parts.size(), not_known);
  for (std::size_t s = 0; s < places.parts.size(); ++s) {
    if (places.parts[s].turn_lines.empty()) continue;
    std::vector<int> harmonics = places.parts[s].turn_lines;
    const OrderLines::TurnLines turn = lines.turn_lines(kinematics.signatures[s].turn);
    std::erase_if(harmonics, [&](int h) { return 2 * h >= turn.samples; });
    if (std::ssize(harmonics) < fewest_phases) continue;
    over[s] = over_random_phases(turn.lines, harmonics);
  }
  return over;
}

}  // namespace rvbench::analysis
