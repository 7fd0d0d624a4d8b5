#include "analysis/tpa/contribution_ranking.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

bool counts(const PathContributions& contributions, const TpaBand& band, Index line) {
  return contributions.is_used[std::size_t(line)] && holds(band, contributions.grid, line);
}

// Of one target over one band.
struct Sums {
  Eigen::VectorXcd with_target;  // Σ P·conj(Y), one a path
  double measured = 0;           // Σ|Y|²
  double synthesised = 0;
  Index lines = 0, left_out = 0;
};

Sums sums_of(const PathContributions& contributions, const TpaBand& band, Index target) {
  Sums sums;
  sums.with_target = Eigen::VectorXcd::Zero(contributions.forces.rows);
  for (Index line = 0; line < contributions.grid.lines; ++line) {
    if (!holds(band, contributions.grid, line)) continue;
    if (!contributions.is_used[std::size_t(line)]) {
      ++sums.left_out;
      continue;
    }
    const Eigen::RowVectorXcd measured = contributions.measured_targets[line].row(target);
    const Eigen::MatrixXcd partial = contributions.partial(line, target);
    sums.with_target += partial * measured.adjoint();
    sums.measured += measured.squaredNorm();
    sums.synthesised += partial.colwise().sum().squaredNorm();
    ++sums.lines;
  }
  return sums;
}

TargetRanking ranking_of(const PathContributions& contributions, const TpaBand& band, Index target,
                         const Eigen::VectorXd& mean_squares) {
  constexpr Require require{"rank_contributions"};
  const Sums sums = sums_of(contributions, band, target);
  require(sums.lines + sums.left_out > 0, "a band without lines");
  const double per_power = mean_square_per_power / double(contributions.forces.columns);
  TargetRanking ranking{target,
                        band,
                        {},
                        std::sqrt(per_power * sums.measured),
                        std::sqrt(per_power * sums.synthesised),
                        contributions.validation.score(band),
                        sums.lines,
                        sums.left_out};
  for (Index path = 0; path < mean_squares.size(); ++path) {
    const std::complex<double> with_target = sums.with_target[path];
    ranking.paths.push_back({path, std::sqrt(mean_squares[path]), std::arg(with_target),
                             sums.measured > 0 ? with_target.real() / sums.measured : 0});
  }
  std::stable_sort(ranking.paths.begin(), ranking.paths.end(),
                   [](const auto& a, const auto& b) { return a.rms > b.rms; });
  return ranking;
}

}  // namespace

Eigen::MatrixXd partial_mean_squares(const PathContributions& contributions, const TpaBand& band) {
  Eigen::MatrixXd powers =
      Eigen::MatrixXd::Zero(contributions.forces.rows, contributions.target_frfs.rows);
  for (Index line = 0; line < contributions.grid.lines; ++line) {
    if (!counts(contributions, band, line)) continue;
    const Eigen::VectorXd force_powers = contributions.forces[line].cwiseAbs2().rowwise().mean() -
                                         contributions.force_noise.col(line);
    powers += force_powers.asDiagonal() * contributions.target_frfs[line].cwiseAbs2().transpose();
  }
  return (mean_square_per_power * powers).cwiseMax(0);
}

std::vector<TargetRanking> rank_contributions(const PathContributions& contributions,
                                              const std::vector<TpaBand>& bands) {
  constexpr Require require{"rank_contributions"};
  require(!bands.empty(), "no band");
  std::vector<TargetRanking> rankings;
  for (const TpaBand& band : bands) {
    const Eigen::MatrixXd powers = partial_mean_squares(contributions, band);
    for (Index target = 0; target < powers.cols(); ++target) {
      rankings.push_back(ranking_of(contributions, band, target, powers.col(target)));
    }
  }
  return rankings;
}

}  // namespace rvbench::analysis
