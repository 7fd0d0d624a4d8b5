#include "sim/robot/path_ranking.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace rvbench;

namespace {

// Each path reaches each target, by a factor of up to `factor` more or less than 1.
Eigen::MatrixXd responses(Eigen::Index paths, double factor, sim::Draw& draw) {
  Eigen::MatrixXd rms(paths, 3);
  for (double& value : rms.reshaped()) value = draw.within_factor(factor);
  return rms;
}

// Paths by what they contribute, the largest first.
std::vector<Eigen::Index> ranked(const Eigen::VectorXd& contribution) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(contribution.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Eigen::Index>(i);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return contribution[a] > contribution[b]; });
  return order;
}

}  // namespace

TEST_CASE("strengths make each leader lead by its margin, whatever the responses are",
          "[sim][robot]") {
  const sim::PathRanking ranking{{6, 13, 6}, {0.12, 0.29, 0.2}};
  sim::Draw draw(static_cast<std::uint64_t>(GENERATE(range(1, 30))));
  Eigen::MatrixXd rms = responses(18, 5, draw);
  rms.row(6) << 5, 0.5, 5;  // each leader leads by its own strength, not at the other's target
  rms.row(13) << 0.5, 5, 0.5;
  const auto strengths = sim::ranked_strengths(rms, ranking, draw);
  REQUIRE(strengths);
  CHECK(strengths->minCoeff() > 0);
  for (Eigen::Index target = 0; target < 3; ++target) {
    const Eigen::VectorXd contribution = strengths->cwiseProduct(rms.col(target));
    const auto order = ranked(contribution);
    CHECK(order[0] == ranking.leaders[std::size_t(target)]);
    CHECK(contribution[order[0]] / contribution[order[1]] ==
          Approx(1 + ranking.margins[std::size_t(target)]).epsilon(1e-12));
  }
}

TEST_CASE("two paths that reach all targets alike cannot lead at one each", "[sim][robot]") {
  sim::Draw draw(1);
  Eigen::MatrixXd rms = responses(18, 5, draw);
  rms.row(6) = 2 * rms.row(13);
  CHECK_FALSE(sim::ranked_strengths(rms, {{6, 13, 6}, {0.1, 0.1, 0.1}}, draw));
}

TEST_CASE("a ranking that is none is refused", "[sim][robot]") {
  sim::Draw draw(1);
  const Eigen::MatrixXd rms = responses(18, 5, draw);
  CHECK_THROWS_AS(sim::ranked_strengths(rms, {{6, 18, 6}, {0.1, 0.1, 0.1}}, draw),
                  std::invalid_argument);
  CHECK_THROWS_AS(sim::ranked_strengths(rms, {{6, 13, 6}, {0.1, 0, 0.1}}, draw),
                  std::invalid_argument);
  CHECK_THROWS_AS(sim::ranked_strengths(rms.leftCols(2), {{6, 13, 6}, {0.1, 0.1, 0.1}}, draw),
                  std::invalid_argument);
}
