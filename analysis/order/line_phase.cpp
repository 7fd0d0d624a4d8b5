#include "analysis/order/line_phase.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "analysis/fft.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fm_threshold = 10;    // line over noise
constexpr double hardly_above = 4;     // of the noise: one Rayleigh sample in 55 reaches it
constexpr double noise_away = 1.5;     // of the band
constexpr double most_settling = 0.2;  // of the samples
constexpr double kaiser_beta = 7.86;   // 80 dB
// Of the taps, for 80 dB between a third and two thirds of the band: Kaiser's formula.
constexpr double taps_per_band = (80 - 7.95) / (2.285 * units::two_pi / 3);

// Lets through what is slower than about half the band, at every sample alike: over what a constant
// would give, so that the ends have the right level, too.
class LowPass {
 public:
  LowPass(Eigen::Index samples, double band)
      : half_(static_cast<Eigen::Index>(std::ceil(taps_per_band / band / 2))),
        samples_(samples),
        padded_(fast_size(samples + 2 * half_)) {
    Eigen::VectorXd taps = Eigen::VectorXd::Zero(padded_);
    for (Eigen::Index i = -half_; i <= half_; ++i) {
      const double x = std::numbers::pi * band * static_cast<double>(i);
      const double edge = static_cast<double>(i) / static_cast<double>(half_ + 1);
      taps[i < 0 ? i + padded_ : i] =
          (i == 0 ? 1 : std::sin(x) / x) *
          std::cyl_bessel_i(0, kaiser_beta * std::sqrt(1 - edge * edge));
    }
    response_ = fft(taps / taps.sum());
    level_ = through(Eigen::VectorXd::Ones(samples));
  }

  Eigen::Index half() const { return half_; }

  Eigen::VectorXcd operator()(const Eigen::VectorXcd& z) const {
    Eigen::VectorXcd slow(samples_);
    slow.real() = through(z.real()).cwiseQuotient(level_);
    slow.imag() = through(z.imag()).cwiseQuotient(level_);
    return slow;
  }

 private:
  static Eigen::Index fast_size(Eigen::Index least) {
    Eigen::Index size = 64;
    while (size < least) size *= 2;
    for (const Eigen::Index eighths : {5, 6, 7}) {
      if (size / 8 * eighths >= least) return size / 8 * eighths;
    }
    return size;
  }

  Eigen::VectorXd through(const Eigen::VectorXd& x) const {
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(padded_);
    padded.head(samples_) = x;
    return inverse_fft(fft(padded).cwiseProduct(response_), padded_).head(samples_);
  }

  Eigen::Index half_, samples_, padded_;
  Eigen::VectorXcd response_;
  Eigen::VectorXd level_;
};

// Cycles of a ridge since the first sample: straight lines between its blocks, level beyond them.
Eigen::VectorXd cycles_of(const LineRidge& ridge, double rate_Hz, Eigen::Index samples) {
  const auto frequency_Hz = [&](double t_s) {
    const double last = static_cast<double>(ridge.frequency_Hz.size() - 1);
    const double place = std::clamp((t_s - ridge.start_s) / ridge.step_s, 0.0, last);
    const auto below = static_cast<Eigen::Index>(place);
    const auto above = std::min(below + 1, ridge.frequency_Hz.size() - 1);
    const double t = place - static_cast<double>(below);
    return (1 - t) * ridge.frequency_Hz[below] + t * ridge.frequency_Hz[above];
  };
  Eigen::VectorXd cycles(samples);
  double before_Hz = frequency_Hz(0);
  cycles[0] = 0;
  for (Eigen::Index i = 1; i < samples; ++i) {
    const double here_Hz = frequency_Hz(static_cast<double>(i) / rate_Hz);
    cycles[i] = cycles[i - 1] + (before_Hz + here_Hz) / (2 * rate_Hz);
    before_Hz = here_Hz;
  }
  return cycles;
}

// x, turned back by so many cycles.
Eigen::VectorXcd turned_back(const Eigen::Ref<const Eigen::VectorXd>& x,
                             const Eigen::VectorXd& cycles, double away) {
  Eigen::VectorXcd z(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    z[i] = x[i] * std::polar(1.0, -units::two_pi * (cycles[i] + away * static_cast<double>(i)));
  }
  return z;
}

double usual_power(const Eigen::VectorXcd& z) {
  const Eigen::VectorXd power = z.cwiseAbs2();
  return median({power.begin(), power.end()}) / std::numbers::ln2;
}

void check(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz, const LineRidge& ridge,
           double band_Hz) {
  constexpr Require require{"line_phase"};
  require_positive(rate_Hz, "line_phase", "rate_Hz");
  require_positive(band_Hz, "line_phase", "band_Hz");
  require(ridge.frequency_Hz.size() > 0 && ridge.step_s > 0, "the ridge is empty");
  require(x.size() >= 4 && x.allFinite(), "needs at least 4 finite samples");
  const double reach_Hz = (noise_away + 1) * band_Hz;
  require(ridge.frequency_Hz.minCoeff() >= reach_Hz &&
              ridge.frequency_Hz.maxCoeff() + reach_Hz <= rate_Hz / 2,
          "the ridge and 2.5 bands beside must lie within half the rate");
}

}  // namespace

double LinePhase::mean_frequency_Hz() const {
  const Eigen::Index last = cycles.size() - 1 - settling;
  return (cycles[last] - cycles[settling]) * rate_Hz / static_cast<double>(last - settling);
}

std::optional<LinePhase> line_phase(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                                    const LineRidge& ridge, double band_Hz) {
  check(x, rate_Hz, ridge, band_Hz);
  const double band = band_Hz / rate_Hz;
  const LowPass low_pass(x.size(), band);
  constexpr Require require{"line_phase"};
  require(static_cast<double>(low_pass.half()) <= most_settling * static_cast<double>(x.size()),
          "the record is too short for so narrow a band");

  LinePhase line;
  line.rate_Hz = rate_Hz;
  line.settling = low_pass.half();
  line.cycles = cycles_of(ridge, rate_Hz, x.size());
  const Eigen::VectorXcd left = low_pass(turned_back(x, line.cycles, 0));
  const double noise =
      std::min(usual_power(low_pass(turned_back(x, line.cycles, noise_away * band))),
               usual_power(low_pass(turned_back(x, line.cycles, -noise_away * band))));
  const double power = left.squaredNorm() / static_cast<double>(left.size());
  if (!(power > fm_threshold * noise)) return std::nullopt;
  line.carrier_over_noise = noise > 0 ? power / noise : std::numeric_limits<double>::infinity();
  line.standard_error_cycles = std::sqrt(noise / (2 * power)) / units::two_pi;
  line.amplitude = 2 * left.cwiseAbs();
  line.faded = static_cast<double>((left.cwiseAbs2().array() < hardly_above * noise).count()) /
               static_cast<double>(left.size());
  double unwrapped = 0;
  for (Eigen::Index i = 1; i < left.size(); ++i) {
    unwrapped += std::arg(left[i] * std::conj(left[i - 1])) / units::two_pi;
    line.cycles[i] += unwrapped;
  }
  return line;
}

std::optional<ShaftAngle> angle_of_line(const LinePhase& line, double start_s, double order) {
  require_positive(order, "angle_of_line", "order");
  return ShaftAngle::of_turns(line.cycles / order, start_s, 1 / line.rate_Hz);
}

}  // namespace rvbench::analysis
