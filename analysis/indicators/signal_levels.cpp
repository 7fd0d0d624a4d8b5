#include "analysis/indicators/signal_levels.hpp"

#include <cmath>

#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

SignalLevels signal_levels(const Eigen::Ref<const Eigen::VectorXd>& x) {
  constexpr Require require{"signal_levels"};
  require(x.size() >= 1 && x.allFinite(), "needs at least 1 sample, and only finite ones");
  const Eigen::ArrayXd swing = x.array() - x.mean();
  SignalLevels levels;
  levels.rms = std::sqrt(swing.square().mean());
  levels.peak = swing.abs().maxCoeff();
  if (levels.rms > 0) levels.crest_factor = levels.peak / levels.rms;
  levels.kurtosis = kurtosis(x);
  return levels;
}

}  // namespace rvbench::analysis
