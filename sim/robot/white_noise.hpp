#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace rvbench::sim {

/// Adds independent normal deviates of this RMS. The same seed gives the same noise on every
/// machine.
///
/// Source  Marsaglia & Bray, SIAM Rev. 6(3), 260-264 (1964), on Steele, Lea & Flood's SplitMix64,
///         ACM SIGPLAN Not. 49(10), 453-472 (2014): dozens of millions are asked for
void add_white_noise(Eigen::Ref<Eigen::VectorXd> samples, double rms, std::uint64_t seed);

}  // namespace rvbench::sim
