#include "analysis/order/standing_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double over_leakage = 2;

double leaked_to(double place, const std::vector<StandingLine>& stronger) {
  double sum = 0;
  for (const StandingLine& line : stronger) {
    sum += line.amplitude * hann_leakage(place - line.place);
  }
  return sum;
}

}  // namespace

double hann_leakage(double lines_away) {
  const double d = std::abs(lines_away);
  return d <= 2 ? 1 : 1 / (std::numbers::pi * d * (d * d - 1));
}

std::vector<StandingLine> standing_lines(const Spectrum& spectrum, const LineFloor& floor,
                                         Eigen::Index last, double alpha) {
  const Eigen::VectorXd& amplitude = spectrum.amplitude;
  Require{"standing_lines"}(floor.power.size() == amplitude.size(), "the floor is of another one");
  std::vector<StandingLine> peaks;
  for (Eigen::Index i = 2; i < std::min(last, amplitude.size() - 1); ++i) {
    if (amplitude[i] < amplitude[i - 1] || amplitude[i] <= amplitude[i + 1]) continue;
    const double p = line_p_value(floor.power[i] / floor.floor[i], 1, floor.floor_lines[i]);
    if (p <= alpha) peaks.push_back({place_of_tone(amplitude, i), amplitude[i], p});
  }
  std::ranges::sort(peaks, std::greater<>(), &StandingLine::amplitude);
  std::vector<StandingLine> standing;
  for (const StandingLine& peak : peaks) {
    if (peak.amplitude > over_leakage * leaked_to(peak.place, standing)) standing.push_back(peak);
  }
  return standing;
}

}  // namespace rvbench::analysis
