#include "analysis/envelope_lines.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/hilbert.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

/// Even angle steps fine enough for all the envelope's bandwidth, rate/4 at the most.
int samples_per_turn(double rate_Hz, double speed_Hz) {
  int samples = 32;
  while (samples < 1024 && samples * speed_Hz < rate_Hz / 2) samples *= 2;
  return samples;
}

Eigen::VectorXd without_average_period(const Eigen::VectorXd& x, Eigen::Index periods) {
  const Eigen::Index length = x.size() / periods;
  const Eigen::Map<const Eigen::MatrixXd> folded(x.data(), length, periods);
  const Eigen::VectorXd average = folded.rowwise().mean();
  return x - average.replicate(periods, 1);
}

/// Mean frequency of x, from its zero crossings, as an order.
double carrier_order(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz, double speed_Hz) {
  const Eigen::Index n = x.size();
  const auto crossings = (x.head(n - 1).array() * x.tail(n - 1).array() < 0).count();
  return 0.5 * static_cast<double>(crossings) * rate_Hz / static_cast<double>(n) / speed_Hz;
}

struct Sums {
  double statistic = 0;
  double excess = 0;  ///< power above the floor
  int lines = 0;
};

/// The line nearest to `order`; −1 where the spectrum or the carrier ends.
Eigen::Index line_at(const EnvelopeSpectra& envelope, double order) {
  const auto line = static_cast<Eigen::Index>(std::lround(order / envelope.whole.resolution));
  const bool inside =
      line >= 2 && line < envelope.whole.amplitude.size() - 1 && order < envelope.highest_order;
  return inside ? line : -1;
}

Sums sum_lines(const LineFloor& floor, const EnvelopeSpectra& envelope,
               const std::vector<SignatureLine>& lines, double stretch,
               std::vector<double>* excess_of_line) {
  Sums sums;
  for (const SignatureLine& wanted : lines) {
    const Eigen::Index line = line_at(envelope, wanted.order * stretch);
    double base = line < 0 ? 0 : floor.floor[line];
    for (const double rival : wanted.rivals) {
      const Eigen::Index other = line_at(envelope, rival);
      if (other >= 0) base = std::max(base, floor.power[other]);
    }
    const double excess = line < 0 ? 0 : floor.power[line] - base;
    if (excess_of_line != nullptr) excess_of_line->push_back(std::max(excess, 0.0));
    if (line < 0) continue;
    sums.statistic += floor.power[line] / base;
    sums.excess += excess;
    ++sums.lines;
  }
  return sums;
}

}  // namespace

EnvelopeSpectra envelope_spectra(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                 double start_s, const ShaftAngle& angle, double period_turns) {
  EnvelopeSpectra result;
  const int per_turn = samples_per_turn(rate_Hz, angle.mean_speed_Hz());
  const Eigen::VectorXd over_angle =
      angle.resample(envelope(x), rate_Hz, start_s, period_turns, per_turn);
  if (over_angle.size() < 16) return result;

  result.mean = over_angle.mean();
  result.highest_order = 0.5 * carrier_order(x, rate_Hz, angle.mean_speed_Hz());
  result.periods = std::round(static_cast<double>(over_angle.size()) / per_turn / period_turns);
  const auto periods = static_cast<Eigen::Index>(result.periods);
  const Eigen::VectorXd swing = over_angle.array() - result.mean;
  result.whole = amplitude_spectrum(swing, per_turn, Window::hann);
  result.lines = line_floor(result.whole, periods);
  if (periods >= 2 && over_angle.size() % periods == 0) {
    result.unlocked = line_floor(
        amplitude_spectrum(without_average_period(over_angle, periods), per_turn, Window::hann),
        periods);
  } else {
    result.unlocked = result.lines;
  }
  return result;
}

FamilyScore score_family(const EnvelopeSpectra& envelope, const Signature& signature,
                         const std::vector<SignatureLine>& lines) {
  FamilyScore score;
  score.order = signature.order;
  if (lines.empty() || !(envelope.mean > 0)) return score;
  const double resolution = envelope.whole.resolution;
  const LineFloor& floor = signature.slip > 0 ? envelope.unlocked : envelope.lines;

  // Orders are tried so densely that the highest line moves by half a line from try to try.
  double highest = 0;
  for (const SignatureLine& line : lines) highest = std::max(highest, line.order);
  const auto tries = static_cast<int>(std::ceil(2 * signature.slip * highest / resolution));
  double best_stretch = 1;
  Sums best = sum_lines(floor, envelope, lines, 1, nullptr);
  for (int i = -tries; i <= tries; ++i) {
    const double stretch = tries == 0 ? 1 : 1 + signature.slip * i / tries;
    const Sums sums = sum_lines(floor, envelope, lines, stretch, nullptr);
    if (sums.statistic > best.statistic) {
      best = sums;
      best_stretch = stretch;
    }
  }
  std::vector<double> excess;
  sum_lines(floor, envelope, lines, best_stretch, &excess);
  for (const double power : excess) score.line_depths.push_back(std::sqrt(power) / envelope.mean);
  score.order = signature.order * best_stretch;
  score.statistic = best.statistic;
  score.p_value =
      std::min(1.0, line_p_value(best.statistic, best.lines, floor.floor_lines) * (2 * tries + 1));
  score.depth = std::sqrt(std::max(best.excess, 0.0)) / envelope.mean;
  return score;
}

}  // namespace rvbench::analysis
