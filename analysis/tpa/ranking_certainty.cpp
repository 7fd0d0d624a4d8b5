#include "analysis/tpa/ranking_certainty.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
constexpr Require require{"ranking_certainty"};
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

Interval95 interval_of(double estimate, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double low = quantile(values, 0.025), high = quantile(values, 0.975);
  if (!(low > 0)) return {0, high};
  return {estimate * estimate / high, estimate * estimate / low};
}

RankingCertainty certainty_of(const TargetRanking& ranking, Index column,
                              const std::vector<Replicate>& replicates) {
  const std::size_t paths = ranking.paths.size();
  RankingCertainty certainty{{}, std::vector<double>(paths - 1, 0), std::vector<double>(paths, 0)};
  for (std::size_t i = 0; i < paths; ++i) {
    std::vector<double> values;
    for (const Replicate& rms : replicates) values.push_back(rms(ranking.paths[i].path, column));
    certainty.rms.push_back(interval_of(ranking.paths[i].rms, std::move(values)));
  }
  for (const Replicate& rms : replicates) {
    for (std::size_t i = 0; i + 1 < paths; ++i) {
      const bool held = rms(ranking.paths[i].path, column) > rms(ranking.paths[i + 1].path, column);
      if (held) ++certainty.order_held[i];
    }
    Index first = 0;
    rms.col(column).maxCoeff(&first);
    for (std::size_t i = 0; i < paths; ++i) {
      if (ranking.paths[i].path == first) ++certainty.led[i];
    }
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
