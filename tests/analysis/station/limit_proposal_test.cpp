#include "analysis/station/limit_proposal.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::IndicatorHistory;
using analysis::LimitProposal;
using analysis::LimitSide;
using analysis::propose_limits;

namespace {

std::vector<double> units(Eigen::Index count, unsigned seed) {
  const Eigen::VectorXd x = 1 + 0.1 * test::white_noise(count, seed).array();
  return {x.begin(), x.end()};
}

LimitProposal proposed(const IndicatorHistory& history) { return propose_limits({history}).at(0); }

}  // namespace

TEST_CASE("a proposal says what it rests on and what it would have changed",
          "[analysis][station]") {
  IndicatorHistory history{"acceleration_rms", "1815 rpm, 100 % load", LimitSide::max, {}, {}};
  history.good = units(50, 1);
  history.history = history.good;
  history.history.insert(history.history.end(), {3.0, 4.0});  // one that failed, one that passed
  history.has_limit = true;
  history.limit = 3.5;
  const LimitProposal proposal = proposed(history);
  CHECK(proposal.refusal.empty());
  CHECK(proposal.indicator == "acceleration_rms");
  CHECK(proposal.learnt.units == 50);
  CHECK(proposal.learnt.limit > 1.3);
  CHECK(proposal.learnt.limit < 1.7);
  CHECK(proposal.judged == 52);
  CHECK(proposal.beyond == 2);
  CHECK(proposal.would_fail == 1);
  CHECK(proposal.would_pass == 0);
  CHECK(proposal.share_that_changes() == Approx(1.0 / 52));
  CHECK_FALSE(proposal.good_beyond);
}

TEST_CASE("a limit in force that was too narrow would let units pass", "[analysis][station]") {
  IndicatorHistory history{"efficiency", "605 rpm", LimitSide::min, {}, {}};
  history.good = units(50, 2);
  history.history = {0.95, 0.2};
  history.has_limit = true;
  history.limit = 0.99;
  const LimitProposal proposal = proposed(history);
  CHECK(proposal.learnt.limit < 0.8);
  CHECK(proposal.would_pass == 1);
  CHECK(proposal.would_fail == 0);
  CHECK(proposal.beyond == 1);
}

TEST_CASE("a noisy unit in the learning set is told to be beyond", "[analysis][station]") {
  IndicatorHistory history{"kurtosis", "605 rpm", LimitSide::max, {}, {}};
  history.good = units(40, 3);
  CHECK_FALSE(proposed(history).good_beyond);
  history.good[7] = 5;
  CHECK(proposed(history).good_beyond);
  CHECK(proposed(history).share_that_changes() == 0);
}

TEST_CASE("cells with too few units are refused, the others proposed", "[analysis][station]") {
  IndicatorHistory few{"kurtosis", "605 rpm", LimitSide::max, units(9, 4), {}};
  IndicatorHistory many{"kurtosis", "1210 rpm", LimitSide::max, units(30, 4), {}};
  const auto proposals = propose_limits({few, many});
  REQUIRE(proposals.size() == 2);
  CHECK(proposals[0].refusal == "9 units, and a limit takes 20");
  CHECK(proposals[1].refusal.empty());
  CHECK(propose_limits({}).empty());
}
