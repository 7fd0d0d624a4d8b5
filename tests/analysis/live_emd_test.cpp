#include "analysis/emd/live_emd.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Emd;
using analysis::emd;
using analysis::LiveEmd;

namespace {

constexpr Eigen::Index n = 60000;

// Noise over a slow swing and a slope: IMFs of every speed, and a residue.
Eigen::VectorXd signal() {
  return test::white_noise(n, 11) + 3 * test::tone(3, n, 4960) + test::times_s(n, 4960).matrix();
}

// What came out, IMF by IMF, the residue last.
using Came = std::vector<std::vector<double>>;

void take_all(LiveEmd& live, Came& came) {
  for (std::size_t imf = 0; imf < came.size(); ++imf) {
    const Eigen::VectorXd fresh = live.take(int(imf));
    came[imf].insert(came[imf].end(), fresh.begin(), fresh.end());
  }
}

Came decompose(const Eigen::VectorXd& x, Eigen::Index step, int imfs) {
  LiveEmd live({.imfs = imfs});
  Came came(std::size_t(imfs) + 1);
  for (Eigen::Index known = 0; known < x.size(); known += step) {
    live.add(x.segment(known, std::min(step, x.size() - known)));
    take_all(live, came);
  }
  live.end();
  take_all(live, came);
  return came;
}

double largest_difference(const std::vector<double>& came, const Eigen::VectorXd& expected) {
  REQUIRE(came.size() == std::size_t(expected.size()));
  const Eigen::Map<const Eigen::VectorXd> each(came.data(), expected.size());
  return (each - expected).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("live IMFs are those of the whole record", "[analysis][emd][law]") {
  const Eigen::VectorXd x = signal();
  const Eigen::Index step = GENERATE(97, 4960, n);
  const Emd whole = emd(x);
  REQUIRE(whole.imfs.cols() == 9);
  const Came came = decompose(x, step, 9);
  for (Eigen::Index imf = 0; imf < 9; ++imf) {
    CAPTURE(imf);
    CHECK(largest_difference(came[std::size_t(imf)], whole.imfs.col(imf)) < 1e-11);
  }
  CHECK(largest_difference(came.back(), whole.residue) < 1e-11);
}

TEST_CASE("how the samples are parted changes no bit of what is live", "[analysis][emd][law]") {
  const Eigen::VectorXd x = signal();
  const bool are_the_same = decompose(x, 331, 9) == decompose(x, n, 9);
  CHECK(are_the_same);
}

TEST_CASE("what has come out is final, and comes soon", "[analysis][emd]") {
  const Eigen::VectorXd x = signal();
  const Emd whole = emd(x);
  LiveEmd live;
  live.add(x.head(n / 2));
  double most_behind = 0;
  for (int imf = 0; imf < 4; ++imf) {
    CAPTURE(imf);
    const Eigen::VectorXd come = live.take(imf);
    REQUIRE(come.size() > 0);
    CHECK(come.size() == live.done(imf));
    CHECK((come - whole.imfs.col(imf).head(come.size())).cwiseAbs().maxCoeff() < 1e-11);
    // Of white noise IMF k has an extremum every 1.45 · 2^k samples. Each of the ten sifts, also of
    // the IMFs before, waits for a block of 16 and for 60 more.
    most_behind += 10 * 1.45 * std::pow(2, imf) * (60 + 16);
    CHECK(double(live.known() - live.done(imf)) < most_behind);
  }
}

TEST_CASE("a signal of few swings has no more IMFs live than as a record", "[analysis][emd]") {
  const Eigen::VectorXd x = test::tone(5, 2000, 1000) + test::times_s(2000, 1000).matrix();
  const Emd whole = emd(x);
  const Came came = decompose(x, 100, 9);
  for (std::size_t imf = 0; imf < 9; ++imf) {
    const bool is_there = Eigen::Index(imf) < whole.imfs.cols();
    CHECK(came[imf].empty() != is_there);
    if (is_there) CHECK(largest_difference(came[imf], whole.imfs.col(Eigen::Index(imf))) < 1e-12);
  }
  CHECK(largest_difference(came.back(), whole.residue) < 1e-12);
}

TEST_CASE("a signal that does not swing is all residue", "[analysis][emd]") {
  LiveEmd live;
  live.add(Eigen::VectorXd::LinSpaced(500, 0, 1));
  CHECK(live.done(9) == 0);
  live.end();
  CHECK((live.take(9) - Eigen::VectorXd::LinSpaced(500, 0, 1)).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(live.take(0).size() == 0);
}

TEST_CASE("a live EMD refuses what it cannot answer, and goes on", "[analysis][emd][errors]") {
  CHECK_THROWS_AS(LiveEmd({.imfs = 0}), std::invalid_argument);
  LiveEmd live;
  live.add(test::white_noise(1000, 1));
  Eigen::VectorXd broken = test::white_noise(1000, 2);
  broken[500] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(live.add(broken), "LiveEmd: sample not finite");
  CHECK(live.known() == 1000);
  live.add(test::white_noise(1000, 2));
  CHECK(live.known() == 2000);
}
