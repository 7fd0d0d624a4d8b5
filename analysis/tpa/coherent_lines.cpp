#include "analysis/tpa/coherent_lines.hpp"

#include "hal/types/recording.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

using Eigen::Index;

CoherentLines coherent_lines(const std::vector<FrequencyResponse>& set, double least) {
  constexpr Require require{"coherent_lines"};
  require(!set.empty(), "no frequency response");
  require(least >= 0 && least <= 1, "least coherence must be in [0, 1]");
  const Index lines = set.front().values.size();
  Eigen::ArrayXd weighted = Eigen::ArrayXd::Zero(lines), weight = weighted;
  for (const FrequencyResponse& frf : set) {
    require(frf.values.size() == lines, "responses of other lines");
    if (frf.coherence.size() == 0) continue;
    require(frf.coherence.size() == lines, "coherence of other lines");
    const Eigen::ArrayXd power = frf.values.array().abs2();
    weighted += power * frf.coherence.array();
    weight += power;
  }
  CoherentLines found{{}, 0, Eigen::VectorXd::Constant(lines, not_known)};
  for (Index line = 0; line < lines; ++line) {
    if (weight[line] > 0) found.coherence[line] = weighted[line] / weight[line];
    const bool is_below = found.coherence[line] < least;
    found.is_used.push_back(!is_below);
    if (is_below) ++found.left_out;
  }
  return found;
}

}  // namespace rvbench::analysis
