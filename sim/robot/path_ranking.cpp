#include "sim/robot/path_ranking.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/require.hpp"

namespace rvbench::sim {
namespace {

constexpr Eigen::Index target_count = 3;
using Caps = Eigen::RowVector3d;

bool leads_somewhere(const PathRanking& ranking, Eigen::Index path) {
  return std::find(ranking.leaders.begin(), ranking.leaders.end(), path) != ranking.leaders.end();
}

void draw_leaders(const PathRanking& ranking, Draw& draw, Eigen::VectorXd& strengths) {
  strengths.setZero();
  for (const Eigen::Index leader : ranking.leaders) {
    if (strengths[leader] == 0) strengths[leader] = draw.within_factor(50);
  }
  strengths /= strengths[ranking.leaders[0]];
}

Caps caps_below(const PathRanking& ranking, const Eigen::MatrixXd& rms,
                const Eigen::VectorXd& strengths) {
  Caps caps;
  for (Eigen::Index t = 0; t < target_count; ++t) {
    const auto k = static_cast<std::size_t>(t);
    caps[t] = strengths[ranking.leaders[k]] * rms(ranking.leaders[k], t) / (1 + ranking.margins[k]);
  }
  return caps;
}

bool leaders_keep_below(const PathRanking& ranking, const Eigen::MatrixXd& rms,
                        const Eigen::VectorXd& strengths, const Caps& caps) {
  for (const Eigen::Index leader : ranking.leaders) {
    for (Eigen::Index t = 0; t < target_count; ++t) {
      const bool leads_here = ranking.leaders[static_cast<std::size_t>(t)] == leader;
      if (!leads_here && strengths[leader] * rms(leader, t) > caps[t]) return false;
    }
  }
  return true;
}

// Fills in the others; false if some target binds none of them.
bool fill_others(const PathRanking& ranking, const Eigen::MatrixXd& rms, const Caps& caps,
                 Draw& draw, Eigen::VectorXd& strengths) {
  std::array<bool, target_count> has_second{};
  for (Eigen::Index path = 0; path < rms.rows(); ++path) {
    if (leads_somewhere(ranking, path)) continue;
    Eigen::Index binding = 0;
    const double most = caps.cwiseQuotient(rms.row(path)).minCoeff(&binding);
    bool& is_taken = has_second[static_cast<std::size_t>(binding)];
    strengths[path] = is_taken ? most * draw.uniform(0.25, 0.85) : most;
    is_taken = true;
  }
  return std::all_of(has_second.begin(), has_second.end(), [](bool has) { return has; });
}

}  // namespace

std::optional<Eigen::VectorXd> ranked_strengths(const Eigen::MatrixXd& rms_per_strength,
                                                const PathRanking& ranking, Draw& draw) {
  constexpr Require require{"ranked_strengths"};
  require(rms_per_strength.cols() == target_count && (rms_per_strength.array() > 0).all(),
          "needs paths x 3 responses above 0");
  for (const Eigen::Index leader : ranking.leaders) {
    require(leader >= 0 && leader < rms_per_strength.rows(), "a leader that is no path");
  }
  for (const double margin : ranking.margins) require(margin > 0, "a margin must be above 0");
  constexpr int most_draws = 20000;
  Eigen::VectorXd strengths(rms_per_strength.rows());
  for (int i = 0; i < most_draws; ++i) {
    draw_leaders(ranking, draw, strengths);
    const Caps caps = caps_below(ranking, rms_per_strength, strengths);
    if (leaders_keep_below(ranking, rms_per_strength, strengths, caps) &&
        fill_others(ranking, rms_per_strength, caps, draw, strengths)) {
      return strengths;
    }
  }
  return std::nullopt;
}

}  // namespace rvbench::sim
