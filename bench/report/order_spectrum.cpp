#include "bench/report/order_spectrum.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "analysis/shaft_angle.hpp"

namespace rvbench::bench {

analysis::Spectrum order_spectrum(const Eigen::VectorXd& x, const Channel& like,
                                  const Recording& recording) {
  const std::optional<analysis::ShaftAngle> angle = analysis::ShaftAngle::of(recording);
  if (!angle) {
    throw std::invalid_argument("order_spectrum: neither shaft angle nor speed of " +
                                recording.source + " is known");
  }
  // As many samples as there were in time: the band of x keeps its room.
  const int per_turn = static_cast<int>(std::ceil(like.rate_Hz / angle->mean_speed_Hz()));
  const Eigen::VectorXd centred = x.array() - x.mean();
  const Eigen::VectorXd even = angle->resample(centred, like.rate_Hz, like.start_s, 1, per_turn);
  if (even.size() < 2) {
    throw std::invalid_argument("order_spectrum: " + recording.source + " holds no whole turn");
  }
  return analysis::amplitude_spectrum(even, per_turn, analysis::Window::hann);
}

}  // namespace rvbench::bench
