#include "bench/report/order_spectrum.hpp"

#include <optional>
#include <stdexcept>

#include "analysis/order/order_spectrum.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::bench {

analysis::Spectrum order_spectrum(const Eigen::VectorXd& x, const Channel& like,
                                  const Recording& recording) {
  const std::optional<analysis::ShaftAngle> angle = analysis::ShaftAngle::of(recording);
  if (!angle) {
    throw std::invalid_argument("order_spectrum: neither shaft angle nor speed of " +
                                recording.source + " is known");
  }
  return analysis::order_spectrum(x, like.rate_Hz, like.start_s, *angle);
}

}  // namespace rvbench::bench
