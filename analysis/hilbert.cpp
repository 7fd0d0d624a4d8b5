#include "analysis/hilbert.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "analysis/fft.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {

namespace {

// What x would be a quarter of a period later, line by line; lines 0 and N/2 have none.
Eigen::VectorXd quadrature(const char* whose, const Eigen::Ref<const Eigen::VectorXd>& x) {
  const Eigen::Index n = x.size();
  if (n < 4) {
    throw std::invalid_argument(std::string(whose) + ": N = " + std::to_string(n) + ", at least 4");
  }
  if (!x.allFinite()) throw std::invalid_argument(std::string(whose) + ": sample not finite");
  Eigen::VectorXcd lines = fft(x) * std::complex<double>(0, -1);
  lines[0] = 0;
  if (n % 2 == 0) lines[n / 2] = 0;
  return inverse_fft(std::move(lines), n);
}

Eigen::VectorXd magnitude(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::VectorXd& y) {
  return (x.array().square() + y.array().square()).sqrt();
}

Eigen::VectorXd phase_rate_Hz(const Eigen::Ref<const Eigen::VectorXd>& x, const Eigen::VectorXd& y,
                              double rate_Hz) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd steps(n - 1);  // of the phase, in turns
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const double ahead = x[i] * y[i + 1] - y[i] * x[i + 1];
    steps[i] = std::atan2(ahead, x[i] * x[i + 1] + y[i] * y[i + 1]) / (2 * std::numbers::pi);
  }
  Eigen::VectorXd frequency_Hz(n);
  frequency_Hz[0] = steps[0];
  frequency_Hz.segment(1, n - 2) = 0.5 * (steps.head(n - 2) + steps.tail(n - 2));
  frequency_Hz[n - 1] = steps[n - 2];
  return frequency_Hz * rate_Hz;
}

}  // namespace

Eigen::VectorXd envelope(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return magnitude(x, quadrature("envelope", x));
}

Eigen::VectorXd instantaneous_frequency_Hz(const Eigen::Ref<const Eigen::VectorXd>& x,
                                           double rate_Hz) {
  require_positive(rate_Hz, "instantaneous_frequency_Hz", "rate_Hz");
  return phase_rate_Hz(x, quadrature("instantaneous_frequency_Hz", x), rate_Hz);
}

AnalyticSignal analytic_signal(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz) {
  require_positive(rate_Hz, "analytic_signal", "rate_Hz");
  const Eigen::VectorXd y = quadrature("analytic_signal", x);
  return {magnitude(x, y), phase_rate_Hz(x, y, rate_Hz)};
}

double crossing_frequency(const Eigen::Ref<const Eigen::VectorXd>& x, double rate) {
  const Eigen::Index n = x.size();
  if (n < 2) return 0;
  const auto crossings = (x.head(n - 1).array() * x.tail(n - 1).array() < 0).count();
  return 0.5 * static_cast<double>(crossings) * rate / static_cast<double>(n);
}

}  // namespace rvbench::analysis
