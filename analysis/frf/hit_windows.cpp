#include "analysis/frf/hit_windows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {

namespace {

// Mean of what comes before the pulse and its foot; 0 if that is too short to tell.
Eigen::RowVectorXd rest_before(const Eigen::MatrixXd& x, const ForcePulse& pulse) {
  const Eigen::Index at_rest = pulse.samples_at_rest();
  if (at_rest == 0) return Eigen::RowVectorXd::Zero(x.cols());
  return x.topRows(at_rest).colwise().mean();
}

}  // namespace

Eigen::VectorXd force_window(const ForcePulse& pulse, Eigen::Index n, double widths) {
  require_positive(widths, "force_window", "widths");
  const auto taper = double(pulse.width());
  const double kept = widths * taper;
  Eigen::VectorXd window(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto outside = double(std::max({pulse.first - i, i - pulse.last, Eigen::Index{0}}));
    const double along = std::clamp((outside - kept) / taper, 0.0, 1.0);
    window[i] = 0.5 * (1 + std::cos(std::numbers::pi * along));
  }
  return window;
}

Eigen::VectorXd exponential_window(Eigen::Index n, double rate_Hz, double decay_s) {
  constexpr Require require{"exponential_window"};
  require_positive(rate_Hz, "exponential_window", "rate_Hz");
  require(decay_s > 0, "decay_s must be above 0");
  return (-Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) / (rate_Hz * decay_s)).exp();
}

FrfRecord windowed_hit(const FrfRecord& record, const HitWindows& windows) {
  constexpr Require require{"windowed_hit"};
  require(record.excitations.cols() == 1, "a hit has one excitation");
  require(record.responses.allFinite(), "responses must be finite");
  const Eigen::Index n = record.excitations.rows();
  const ForcePulse pulse = force_pulse(record.excitations.col(0));
  const Eigen::ArrayXd decay = exponential_window(n, record.rate_Hz, windows.decay_s);
  const Eigen::ArrayXd force = decay * force_window(pulse, n, windows.force_widths).array();

  FrfRecord hit = record;
  hit.excitations.rowwise() -= rest_before(record.excitations, pulse);
  hit.excitations.array().colwise() *= force;
  hit.responses.rowwise() -= rest_before(record.responses, pulse);
  hit.responses.array().colwise() *= decay;
  return hit;
}

double damping_without_window(double damping_ratio, double frequency_Hz, double decay_s) {
  constexpr Require require{"damping_without_window"};
  require_positive(frequency_Hz, "damping_without_window", "frequency_Hz");
  require(decay_s > 0, "decay_s must be above 0");
  const double omega = units::two_pi * frequency_Hz;
  const double sigma = damping_ratio * omega - 1 / decay_s;
  const double damped = omega * std::sqrt(1 - damping_ratio * damping_ratio);
  return sigma / std::hypot(sigma, damped);
}

}  // namespace rvbench::analysis
