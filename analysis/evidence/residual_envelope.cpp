#include "analysis/evidence/residual_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/evidence/gear_combs.hpp"
#include "analysis/fft.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr Index level_lines = 8;  // to either side: a tone is divided by little but itself
constexpr Index fewest_lines = 64;
constexpr double stated_slip = 0.003;  // of a motor's stated speed against its own, in steady load
constexpr double window_reach = 2;     // lines: half the main lobe of a Hann window
constexpr double periodic_reach = 0.25;  // lines: where all turns are whole, a line is one place

// Without the care for overflow of std::abs, which takes longer.
Eigen::VectorXd moduli(const Eigen::VectorXcd& lines) { return lines.cwiseAbs2().cwiseSqrt(); }

bool is_whole(double x) { return std::abs(x - std::round(x)) < 1e-6 * std::max(1.0, x); }

// Whether every turn of the gear train goes into the record a whole number of times.
bool repeats(const Kinematics& kinematics, double turns) {
  if (!is_whole(turns / kinematics.period_turns)) return false;
  return std::ranges::all_of(kinematics.signatures, [&](const Signature& part) {
    return part.shows == Shows::as_blows || part.shows == Shows::as_printed ||
           (is_whole(part.order * turns) && is_whole(part.turn * turns) &&
            is_whole(part.path_order * turns));
  });
}

// Each line over the root mean square of those around it that are not taken out.
void whiten(Eigen::VectorXcd& lines, const std::vector<bool>& taken) {
  const Index n = lines.size();
  Eigen::VectorXd sum(n + 1), count(n + 1);
  sum[0] = count[0] = 0;
  for (Index i = 0; i < n; ++i) {
    const bool counts = !taken[static_cast<std::size_t>(i)];
    sum[i + 1] = sum[i] + (counts ? std::norm(lines[i]) : 0.0);
    count[i + 1] = count[i] + (counts ? 1.0 : 0.0);
  }
  // As many lines to either side as hold `level_lines` that were left.
  const double share = count[n] / static_cast<double>(n);
  const auto reach = static_cast<Index>(static_cast<double>(level_lines) / std::max(share, 0.05));
  for (Index i = 0; i < n; ++i) {
    if (taken[static_cast<std::size_t>(i)]) continue;
    const Index from = std::max<Index>(0, i - reach), end = std::min(n, i + reach + 1);
    const double power = (sum[end] - sum[from]) / (count[end] - count[from]);
    lines[i] = power > 0 ? lines[i] / std::sqrt(power) : std::complex<double>{};
  }
}

// Lines of the mains, of an inverter, of another machine: far above all that is around them, which
// no train of blows is.
std::vector<bool> tones_among(const Eigen::VectorXcd& lines, const std::vector<bool>& taken) {
  constexpr double stands_out = 1000;  // 30 dB over the floor; blows share theirs among many lines
  const LineFloor floor = line_floor({1, moduli(lines)}, taken);
  std::vector<bool> tones(taken.size());
  for (std::size_t i = 0; i < tones.size(); ++i) {
    const auto line = static_cast<Index>(i);
    tones[i] = !taken[i] && floor.power[line] > stands_out * floor.floor[line];
  }
  return tones;
}

}  // namespace

Index envelope_lines(double turns, double top_order, double highest_order) {
  const Index asked = std::min(static_cast<Index>(top_order * turns) / 2,
                               static_cast<Index>(highest_order * turns) + 2 * level_lines);
  return asked < fewest_lines ? 0 : asked;
}

ResidualPlaces residual_places(double turns, double top_order, const Kinematics& kinematics,
                               double highest_order) {
  ResidualPlaces places;
  const auto count = static_cast<Index>(top_order * turns);
  const Index asked = envelope_lines(turns, top_order, highest_order);
  if (count < fewest_lines || asked == 0) return places;
  places.is_periodic = repeats(kinematics, turns);
  const double reach = places.is_periodic ? periodic_reach : window_reach;
  places.gears = locked_lines(kinematics, 1 / turns, static_cast<std::size_t>(count), reach);
  places.locked = locked_lines(kinematics, 1 / turns, static_cast<std::size_t>(asked), reach);
  return places;
}

ResidualEnvelope residual_envelope(const OrderLines& x, const ResidualPlaces& places) {
  ResidualEnvelope result;
  if (x.empty()) return result;
  result.resolution = 1 / x.turns();
  result.order_error = x.angle_is_measured() ? 0 : stated_slip;
  const Index count = std::min(x.lines().size(), std::ssize(places.gears));
  const Index asked = std::ssize(places.locked);
  if (count < fewest_lines || asked == 0) return result;

  const bool is_periodic = places.is_periodic;
  Eigen::VectorXcd lines =
      is_periodic ? Eigen::VectorXcd(x.lines().head(count)) : lines_under_hann(x.lines(), count);
  const auto samples = static_cast<double>(x.samples());
  const double scale = 2 / (samples * samples) / (is_periodic ? 1 : 1.5);
  std::vector<bool> taken(places.gears.begin(), places.gears.begin() + count);
  const std::vector<bool> tones = tones_among(lines, taken);
  for (Index i = 0; i < count; ++i) {
    const auto line = static_cast<std::size_t>(i);
    const double mean_square = scale * std::norm(lines[i]);
    if (taken[line]) {
      result.gears2 += mean_square;
    } else if (!tones[line]) {
      result.residual2 += mean_square;
    }
    taken[line] = taken[line] || tones[line];
    if (taken[line]) lines[i] = 0;
  }
  result.left = static_cast<double>(std::ranges::count(taken, false)) / static_cast<double>(count);
  result.residual = (std::sqrt(scale) * lines).cast<std::complex<float>>();
  whiten(lines, taken);

  // An analytic signal has half of the lines; its square has as many to either side.
  const Index n = next_fast_length(count + asked);
  Eigen::VectorXcd analytic = Eigen::VectorXcd::Zero(n);
  analytic.head(count) = lines;
  const Eigen::VectorXd squared = inverse_complex_fft(std::move(analytic)).cwiseAbs2();
  const Eigen::VectorXcd envelope = fft(squared);
  const double mean = std::abs(envelope[0]);
  if (!(mean > 0)) return result;
  Spectrum depth{result.resolution, 2 / mean * moduli(envelope.head(asked))};
  depth.amplitude.head(3).setZero();
  result.locked = places.locked;
  result.lines = line_floor(depth, result.locked);
  const Eigen::VectorXcd windowed = is_periodic ? lines_under_hann(envelope, asked) : envelope;
  result.windowed = {result.resolution, 2 / mean * moduli(windowed.head(asked))};
  result.windowed.amplitude.head(3).setZero();
  return result;
}

}  // namespace rvbench::analysis
