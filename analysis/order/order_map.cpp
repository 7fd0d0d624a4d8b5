#include "analysis/order/order_map.hpp"

#include "analysis/spectrum.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

OrderMap order_map(const OverAngle& x, const ShaftAngle& angle, int block_turns) {
  constexpr Require require{"order_map"};
  require(block_turns >= 1, "block_turns must be at least 1");
  const Eigen::Index block = Eigen::Index{block_turns} * x.samples_per_turn, hop = block / 2;
  require(block >= 4, "a block needs 4 samples");
  const Eigen::Index size = x.samples.size();
  const Eigen::Index count = size < block ? 0 : (size - block) / hop + 1;

  OrderMap map{1.0 / block_turns, Eigen::MatrixXd(block / 2 + 1, count), {}, {}};
  for (Eigen::Index b = 0; b < count; ++b) {
    map.amplitude.col(b) =
        amplitude_spectrum(x.samples.segment(b * hop, block), x.samples_per_turn, Window::hann)
            .amplitude;
  }
  // Begin, middle and end of each block: a quarter of a block apart, as blocks are a half.
  const double hop_turns = static_cast<double>(hop) / x.samples_per_turn;
  const Eigen::VectorXd edges_s = angle.times_s(x.first_turns, 1 / hop_turns, count + 2);
  map.time_s = edges_s.segment(count > 0 ? 1 : 0, count);
  map.speed_Hz.resize(count);
  for (Eigen::Index b = 0; b < count; ++b) {
    map.speed_Hz[b] = 2 * hop_turns / (edges_s[b + 2] - edges_s[b]);
  }
  return map;
}

}  // namespace rvbench::analysis
