#include "analysis/order/loud_tones.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

using Index = Eigen::Index;

constexpr int most_tones = 8;
constexpr double loud = 0.1;       // of the channel's power
constexpr double off_gears = 0.4;  // lines: of what lies on whole periods the rest is a hundredth
constexpr Index beside = 1;        // lines of a Hann window's lobe to each side

// A line of a spectrum, between two of its lines.
struct Peak {
  double at = 0;     // in lines
  double power = 0;  // of its tone
};

double power_around(const Spectrum& spectrum, Index i) {
  return spectrum.amplitude.segment(i - beside, 2 * beside + 1).squaredNorm() /
         lines_per_hann_line / 2;
}

// The loudest line that is accepted; nothing where none carries enough.
template <typename Accepted>
std::optional<Peak> loudest(const Spectrum& spectrum, double least_power, Accepted accepted) {
  std::optional<Peak> best;
  for (Index i = 2; i + 2 < spectrum.amplitude.size(); ++i) {
    const double a = spectrum.amplitude[i];
    const bool is_top = a >= spectrum.amplitude[i - 1] && a > spectrum.amplitude[i + 1];
    if (!is_top || a * a < least_power) continue;
    const Peak peak{place_of_tone(spectrum.amplitude, i), power_around(spectrum, i)};
    if (peak.power < least_power || (best && peak.power <= best->power)) continue;
    if (accepted(peak)) best = peak;
  }
  return best;
}

// Takes out what a cosine and a sine of these phases fit.
void subtract(Eigen::VectorXd& x, const Eigen::ArrayXd& phase_rad) {
  const Eigen::ArrayXd cosine = phase_rad.cos(), sine = phase_rad.sin();
  const double cc = cosine.square().sum(), ss = sine.square().sum(), cs = (cosine * sine).sum();
  const double xc = (x.array() * cosine).sum(), xs = (x.array() * sine).sum();
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > 0)) return;
  x.array() -=
      (xc * ss - xs * cs) / determinant * cosine + (xs * cc - xc * cs) / determinant * sine;
}

// How much power the spectrum over the angle has in one line near an order.
double power_near(const Spectrum& orders, double order) {
  constexpr double wander = 0.003;  // relative
  const double at = order / orders.resolution;
  const auto from = std::max<Index>(2, static_cast<Index>(at * (1 - wander)) - 1);
  const auto to =
      std::min<Index>(orders.amplitude.size() - 3, static_cast<Index>(at * (1 + wander)) + 1);
  double highest = 0;
  for (Index i = from; i <= to; ++i) highest = std::max(highest, power_around(orders, i));
  return highest;
}

// A look at a piece of the record, which costs little: whether it has a tone where a sound machine
// has none.
bool may_have_loud_tone(const Channel& x, double mean_speed_Hz, const std::vector<double>& sound) {
  constexpr Index piece = 16384;
  constexpr double apart = 2;  // lines of the piece
  const Index n = std::min(piece, x.samples.size());
  const auto middle = x.samples.segment((x.samples.size() - n) / 2, n);
  const double power = (middle.array() - middle.mean()).square().mean();
  const Spectrum spectrum = amplitude_spectrum(middle, x.rate_Hz, Window::hann);
  const double resolution = spectrum.resolution / mean_speed_Hz;
  const auto is_strange = [&](const Peak& peak) {
    const double order = peak.at * resolution, near = apart * resolution;
    const auto next = std::ranges::lower_bound(sound, order - near);
    return next == sound.end() || *next > order + near;
  };
  return loudest(spectrum, loud * power, is_strange).has_value();
}

}  // namespace

std::optional<Channel> without_loud_tones(const Channel& x, const ShaftAngle& angle,
                                          const OrderLines& lines, const std::vector<double>& sound,
                                          const std::function<double(double order)>& from_gears) {
  if (lines.empty() || !may_have_loud_tone(x, lines.mean_speed_Hz(), sound)) return {};
  Channel quiet = x;
  bool is_changed = false;
  const Index n = x.samples.size();
  const double mean_Hz = lines.mean_speed_Hz();
  Spectrum orders = lines.spectrum();
  for (int taken = 0; taken < most_tones; ++taken) {
    const double power = (quiet.samples.array() - quiet.samples.mean()).square().mean();
    const Spectrum hertz = amplitude_spectrum(quiet.samples, x.rate_Hz, Window::hann);
    constexpr double narrower = 1.25;
    const auto in_Hz = loudest(hertz, loud * power, [&](const Peak& peak) {
      const double order = peak.at * hertz.resolution / mean_Hz;
      return peak.power > narrower * power_near(orders, order);
    });
    const auto in_orders = loudest(orders, loud * power, [&](const Peak& peak) {
      return from_gears(peak.at * orders.resolution) > off_gears * orders.resolution;
    });
    if (!in_Hz && !in_orders) break;
    Eigen::ArrayXd phase_rad(n);
    if (in_Hz && (!in_orders || in_Hz->power >= in_orders->power)) {
      const double step_rad = units::two_pi * in_Hz->at * hertz.resolution / x.rate_Hz;
      phase_rad.setLinSpaced(n, 0, step_rad * static_cast<double>(n - 1));
    } else {
      const double order = in_orders->at * orders.resolution;
      for (Index i = 0; i < n; ++i) {
        const double turns = angle.turns_at(x.start_s + static_cast<double>(i) / x.rate_Hz);
        phase_rad[i] = units::two_pi * order * turns;
      }
    }
    subtract(quiet.samples, phase_rad);
    is_changed = true;
    orders = OrderLines(quiet, angle, lines.turns()).spectrum();
  }
  if (!is_changed) return {};
  return quiet;
}

}  // namespace rvbench::analysis
