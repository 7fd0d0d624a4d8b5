#include "analysis/tpa/ranking_certainty.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
constexpr int fewest_replicates = 20;

// RMS of all paths, one column a ranking.
using Replicate = Eigen::MatrixXd;

std::vector<Index> drawn_blocks(Index blocks, std::mt19937_64& engine) {
  std::vector<Index> drawn(static_cast<std::size_t>(blocks));
  std::uniform_int_distribution<Index> any(0, blocks - 1);
  for (Index& block : drawn) block = any(engine);
  return drawn;
}

Replicate replicate_of(const PathContributions& contributions,
                       const std::vector<TargetRanking>& rankings) {
  Replicate rms(contributions.forces.rows, Index(rankings.size()));
  Eigen::MatrixXd powers;
  const TpaBand* band = nullptr;
  for (std::size_t i = 0; i < rankings.size(); ++i) {
    const TargetRanking& ranking = rankings[i];
    const bool is_same = band != nullptr && band->first_Hz == ranking.band.first_Hz &&
                         band->last_Hz == ranking.band.last_Hz;
    if (!is_same) powers = partial_mean_squares(contributions, ranking.band);
    band = &ranking.band;
    rms.col(Index(i)) = powers.col(ranking.target).cwiseSqrt();
  }
  return rms;
}

// Of sorted values, between the two nearest.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * double(sorted.size() - 1);
  const std::size_t below = std::size_t(at);
  const double above = sorted[std::min(below + 1, sorted.size() - 1)];
  return sorted[below] + (at - double(below)) * (above - sorted[below]);
}

Interval95 interval_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.025), quantile(values, 0.975)};
}

// What a replicate says of each path: paths in the ranking's order.
Eigen::VectorXd told_by(const Replicate& rms, const TargetRanking& ranking, Index column) {
  Eigen::VectorXd told(Index(ranking.paths.size()));
  for (Index i = 0; i < told.size(); ++i) {
    const BandContribution& path = ranking.paths[std::size_t(i)];
    const double again = rms(path.path, column);
    told[i] = std::sqrt(std::max(0.0, 2 * path.rms * path.rms - again * again));
  }
  return told;
}

RankingCertainty certainty_of(const TargetRanking& ranking, Index column,
                              const std::vector<Replicate>& replicates) {
  const std::size_t paths = ranking.paths.size();
  RankingCertainty certainty{{}, std::vector<double>(paths - 1, 0), std::vector<double>(paths, 0)};
  Eigen::MatrixXd told(Index(paths), Index(replicates.size()));
  for (std::size_t i = 0; i < replicates.size(); ++i) {
    told.col(Index(i)) = told_by(replicates[i], ranking, column);
  }
  for (Index path = 0; path < told.rows(); ++path) {
    const Eigen::VectorXd values = told.row(path);
    certainty.rms.push_back(interval_of({values.begin(), values.end()}));
  }
  for (const auto& values : told.colwise()) {
    for (Index i = 0; i + 1 < values.size(); ++i) {
      if (values[i] > values[i + 1]) ++certainty.order_held[std::size_t(i)];
    }
    Index first = 0;
    values.maxCoeff(&first);
    ++certainty.led[std::size_t(first)];
  }
  for (double& held : certainty.order_held) held /= double(replicates.size());
  for (double& led : certainty.led) led /= double(replicates.size());
  return certainty;
}

}  // namespace

std::vector<RankingCertainty> ranking_certainty(const FrfDraw& draw, Index blocks,
                                                const PathAnalysis& analysis,
                                                const std::vector<TargetRanking>& rankings,
                                                const Resampling& resampling, unsigned threads) {
  constexpr Require require{"ranking_certainty"};
  require(resampling.replicates >= fewest_replicates, "fewer than 20 replicates");
  require(blocks > 0, "no block");
  std::vector<Replicate> replicates(std::size_t(resampling.replicates));
  const auto one = [&](std::size_t i) {
    std::seed_seq seeds{resampling.seed, std::uint64_t(i)};
    std::mt19937_64 engine(seeds);
    const FrfMatrix other = draw(engine);
    replicates[i] = replicate_of(analysis(other, drawn_blocks(blocks, engine)), rankings);
  };
  parallel_for(replicates.size(), one, threads);
  std::vector<RankingCertainty> certainties;
  for (std::size_t i = 0; i < rankings.size(); ++i) {
    certainties.push_back(certainty_of(rankings[i], Index(i), replicates));
  }
  return certainties;
}

}  // namespace rvbench::analysis
