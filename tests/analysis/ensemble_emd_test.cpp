#include "analysis/emd/ensemble_emd.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Emd;
using analysis::EnsembleOptions;

namespace {

using Method = Emd (*)(const Eigen::Ref<const Eigen::VectorXd>&, const EnsembleOptions&);

constexpr double rate_Hz = 1000;
constexpr Eigen::Index n = 4000;

// A slow tone that rides on nothing, and a fast one that comes and goes: what plain EMD puts into
// one IMF where it is there, and the slow tone where it is not.
Eigen::VectorXd coming_and_going() {
  Eigen::VectorXd x = test::tone(10, n, rate_Hz);
  const Eigen::VectorXd fast = 0.2 * test::tone(120, n, rate_Hz);
  for (const Eigen::Index from : {800, 2000, 3200}) x.segment(from, 300) += fast.segment(from, 300);
  return x;
}

// The share of the slow tone's power in IMF `column`.
double share_of_slow(const Emd& modes, Eigen::Index column) {
  const Eigen::VectorXd slow = test::tone(10, n, rate_Hz);
  const double projected = modes.imfs.col(column).dot(slow) / slow.squaredNorm();
  return projected * projected;
}

double most_in_one(const Emd& modes) {
  double most = 0;
  for (Eigen::Index k = 0; k < modes.imfs.cols(); ++k)
    most = std::max(most, share_of_slow(modes, k));
  return most;
}

}  // namespace

TEST_CASE("an ensemble keeps a tone in one IMF though another comes and goes",
          "[analysis][emd][literature]") {
  // Wu & Huang (2009), sec. 1, name it mode mixing.
  const Eigen::VectorXd x = coming_and_going();
  CHECK(share_of_slow(analysis::emd(x), 0) > 0.3);  // the first IMF has both
  for (const Method method : {analysis::eemd, analysis::ceemdan, analysis::iceemdan}) {
    const Emd modes = method(x, {.members = 40});
    CHECK(share_of_slow(modes, 0) < 0.01);
    CHECK(most_in_one(modes) > 0.7);
  }
}

TEST_CASE("the complete ensembles' IMFs sum to the signal, the plain one's do not",
          "[analysis][emd][law]") {
  const Eigen::VectorXd x = test::white_noise(n, 31).array() + 7;
  for (const Method method : {analysis::ceemdan, analysis::iceemdan}) {
    const Emd modes = method(x, {.members = 8});
    CHECK((modes.imfs.rowwise().sum() + modes.residue - x).cwiseAbs().maxCoeff() < 1e-13);
  }
  // Its residue has the mean of the noise, too: 0.2 / √8 of the signal's.
  const Emd plain = analysis::eemd(x, {.members = 8});
  CHECK((plain.imfs.rowwise().sum() + plain.residue - x).cwiseAbs().maxCoeff() < 1e-13);
  CHECK(test::rms(Eigen::VectorXd(plain.residue.array() - 7)) > 0.5 * 0.2 / std::sqrt(8));
}

TEST_CASE("without noise an ensemble is one EMD", "[analysis][emd][law]") {
  const Eigen::VectorXd x = test::white_noise(n, 32);
  const Emd one = analysis::emd(x);
  for (const Method method : {analysis::eemd, analysis::ceemdan, analysis::iceemdan}) {
    const Emd modes = method(x, {.members = 3, .noise = 0});
    REQUIRE(modes.imfs.cols() == one.imfs.cols());
    CHECK((modes.imfs - one.imfs).cwiseAbs().maxCoeff() < 1e-10);
    CHECK(modes.unreliable_ends == one.unreliable_ends);
  }
}

TEST_CASE("of an ensemble as little is reliable as of its worst member", "[analysis][emd]") {
  const Eigen::VectorXd x = test::white_noise(500, 34);
  const auto ends = [&](Method method, int members) {
    return method(x, {.emd = {.imfs = 4}, .members = members}).unreliable_ends;
  };
  // Each member has other noise, so that the worst of many is hardly the first one.
  for (const Method method : {analysis::eemd, analysis::ceemdan, analysis::iceemdan}) {
    CHECK(ends(method, 20).back() > ends(method, 1).back());
  }
  for (int members = 1; members < 16; ++members) {  // one more can only make it less
    CAPTURE(members);
    const auto fewer = ends(analysis::eemd, members), more = ends(analysis::eemd, members + 1);
    REQUIRE(more.size() >= fewer.size());
    for (std::size_t k = 0; k < fewer.size(); ++k) CHECK(more[k] >= fewer[k]);
  }
}

TEST_CASE("an ensemble gives the same bits for a seed, whatever the number of threads",
          "[analysis][emd][threads]") {
  const Eigen::VectorXd x = test::white_noise(1500, 33);
  for (const Method method : {analysis::eemd, analysis::ceemdan, analysis::iceemdan}) {
    const Emd alone = method(x, {.members = 21, .seed = 5, .threads = 1});
    const Emd four = method(x, {.members = 21, .seed = 5, .threads = 4});
    CHECK(alone.imfs == four.imfs);
    CHECK(alone.residue == four.residue);
    CHECK(method(x, {.members = 21, .seed = 6}).residue != alone.residue);
  }
}

TEST_CASE("noise that was added goes with the root of the members", "[analysis][emd][law]") {
  const Eigen::VectorXd x = test::tone(10, n, rate_Hz);
  const auto left = [&](int members) {
    const Emd modes = analysis::eemd(x, {.members = members});
    return test::rms(Eigen::VectorXd(modes.imfs.rowwise().sum() - x));
  };
  // The mean of independent noise of 0.2 standard deviations of the tone, whose own is √½.
  CHECK(left(16) == Approx(0.2 * std::sqrt(0.5 / 16)).epsilon(0.1));
  CHECK(left(64) == Approx(0.2 * std::sqrt(0.5 / 64)).epsilon(0.1));
}

TEST_CASE("an ensemble refuses what it cannot answer", "[analysis][emd][errors]") {
  Eigen::VectorXd x = test::white_noise(100, 7);
  for (const Method method : {analysis::eemd, analysis::ceemdan, analysis::iceemdan}) {
    CHECK_THROWS_AS(method(x, {.members = 0}), std::invalid_argument);
    CHECK_THROWS_AS(method(x, {.noise = -1}), std::invalid_argument);
    CHECK_THROWS_AS(method(x, {.emd = {.sifts = 0}}), std::invalid_argument);
    Eigen::VectorXd broken = x;
    broken[3] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(method(broken, {}), std::invalid_argument);
    CHECK(method(Eigen::VectorXd(), {.members = 2}).imfs.cols() == 0);
  }
}
