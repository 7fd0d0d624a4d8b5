#include "analysis/order/order_spectrum.hpp"

#include <cmath>

#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {

Spectrum order_spectrum(const OverAngle& x) {
  return amplitude_spectrum(x.samples, x.samples_per_turn, Window::hann);
}

Spectrum order_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz, double start_s,
                        const ShaftAngle& angle) {
  require_positive(rate_Hz, "order_spectrum", "rate_Hz");
  const int per_turn = static_cast<int>(std::ceil(rate_Hz / angle.mean_speed_Hz()));
  const OverAngle even = over_angle(x, rate_Hz, start_s, angle, {per_turn, 1});
  Require{"order_spectrum"}(even.samples.size() >= 2, "the record holds no whole turn");
  return order_spectrum(even);
}

}  // namespace rvbench::analysis
