#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "sim/draw.hpp"

namespace rvbench::sim {

/// Which path is to lead at each target, and by what share of the second.
struct PathRanking {
  std::array<Eigen::Index, 3> leaders{};  ///< the same path may lead at several targets
  std::array<double, 3> margins{};        ///< 0.2: the leader is 20 % above the second
};

/// Strengths of the paths that give such a ranking.
///
/// Leaders' strengths are drawn until none beats another at that one's own target. Each target then
/// has a cap for all other paths, the leader's response over 1 + margin. A path is bound by the
/// target whose cap it meets first: one path of those bound by each target is put right at the cap
/// and is the second there; the others get 25-85 % of what they may.
///
/// @param rms_per_strength  paths x 3: RMS response at a target when only this path acts, > 0
/// @return a strength for each path; none if after 20 000 draws some target still binds no path
/// @throws std::invalid_argument: shape, a leader that is no path, a margin not above 0
std::optional<Eigen::VectorXd> ranked_strengths(const Eigen::MatrixXd& rms_per_strength,
                                                const PathRanking& ranking, Draw& draw);

}  // namespace rvbench::sim
