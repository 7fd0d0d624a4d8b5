#include "analysis/emd/emd.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "hal/types/parallel_for.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Emd;
using analysis::emd;
using analysis::EmdOptions;

namespace {

constexpr double rate_Hz = 4960;
constexpr Eigen::Index n = 24800;

// Largest difference in the middle half, where no end is felt.
double middle_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).segment(a.size() / 4, a.size() / 2).cwiseAbs().maxCoeff();
}

}  // namespace

SCENARIO("tones far apart come out one by one, fastest first", "[analysis][emd]") {
  GIVEN("tones of 501, 61 and 9 Hz on a slope") {
    const Eigen::VectorXd high = 0.5 * test::tone(501, n, rate_Hz, 0.4);
    const Eigen::VectorXd middle = test::tone(61, n, rate_Hz, 1.1);
    const Eigen::VectorXd low = 2 * test::tone(9, n, rate_Hz, 2);
    const Eigen::VectorXd slope = 3 * test::times_s(n, rate_Hz);
    const Emd modes = emd(high + middle + low + slope, {.imfs = 3});

    THEN("each IMF is its tone, the residue is the slope") {
      REQUIRE(modes.imfs.cols() == 3);
      // Extrema fall on samples, not on crests: up to 1 - cos(π·501/4960) = 5 % of the high tone is
      // not seen by a single extremum, little of which is left by the mean of two envelopes.
      CHECK(middle_difference(modes.imfs.col(0), high) < 0.01);
      CHECK(middle_difference(modes.imfs.col(1), middle) < 0.01);
      CHECK(middle_difference(modes.imfs.col(2), low) < 0.02);
      CHECK(middle_difference(modes.residue, slope) < 0.02);
    }
    THEN("nothing is lost") {
      const Eigen::VectorXd sum = modes.imfs.rowwise().sum() + modes.residue;
      CHECK((sum - (high + middle + low + slope)).cwiseAbs().maxCoeff() < 1e-14);
    }
    THEN("the slower the IMF, the longer the ends that are not to be relied on") {
      REQUIRE(modes.unreliable_ends.size() == 3);
      CHECK(modes.unreliable_ends[0] ==
            Approx(6 * rate_Hz / 501 * std::pow(10, 0.25)).epsilon(0.02));
      CHECK(modes.unreliable_ends[1] ==
            Approx(6 * rate_Hz / 61 * std::pow(10, 0.25)).epsilon(0.02));
      // The ends of the slope add three extrema to the 90 of the slow tone.
      CHECK(modes.unreliable_ends[2] == Approx(6 * rate_Hz / 9 * std::pow(10, 0.25)).epsilon(0.04));
    }
  }
  GIVEN("a tone alone") {
    const Eigen::VectorXd tone = test::tone(62, n, rate_Hz, 0.3);
    THEN("it is IMF 1 up to its very ends, and little is left") {
      const Emd modes = emd(tone, {.imfs = 1});
      CHECK((modes.imfs.col(0) - tone).cwiseAbs().maxCoeff() < 0.01);
      CHECK(test::rms(modes.residue) < 0.001);
    }
  }
}

TEST_CASE("the first IMFs do not depend on how many are asked for", "[analysis][emd][law]") {
  const Eigen::VectorXd x = test::white_noise(2000, 5);
  const Emd all = emd(x), three = emd(x, {.imfs = 3});
  REQUIRE(three.imfs.cols() == 3);
  CHECK(three.imfs == all.imfs.leftCols(3));
}

TEST_CASE("an IMF does not depend on what happens far away", "[analysis][emd][law]") {
  // Envelopes forget a knot by 2 - √3 a knot: nothing is left after a few hundred samples. Which
  // makes decomposing in overlapping blocks exact, for this is what a fixed sift count is for.
  const Eigen::VectorXd x = test::white_noise(20000, 6);
  const Emd whole = emd(x, {.imfs = 1}), part = emd(x.head(10000), {.imfs = 1});
  CHECK((part.imfs - whole.imfs.topRows(10000)).topRows(9800).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((part.imfs - whole.imfs.topRows(10000)).bottomRows(5).cwiseAbs().maxCoeff() > 1e-3);
}

TEST_CASE("what does not swing has no IMF", "[analysis][emd]") {
  const Eigen::ArrayXd t = test::times_s(500, 100);
  const Eigen::VectorXd x =
      GENERATE_COPY(Eigen::VectorXd(Eigen::VectorXd::Zero(500)),
                    Eigen::VectorXd(Eigen::VectorXd::Constant(500, 7)), Eigen::VectorXd(3 * t - 1),
                    Eigen::VectorXd((-t).exp()), Eigen::VectorXd((t - 2).square()),
                    Eigen::VectorXd((t < 2.5).cast<double>()));
  const Emd modes = emd(x);
  CHECK(modes.imfs.cols() == 0);
  CHECK(modes.imfs.rows() == 500);
  CHECK(modes.unreliable_ends.empty());
  CHECK((modes.residue - x).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("records of a few samples come back as they are", "[analysis][emd]") {
  for (Eigen::Index samples = 0; samples <= 4; ++samples) {
    const Eigen::VectorXd x = test::tone(1, samples, 2);  // +1, -1, +1, -1
    const Emd modes = emd(x);
    CHECK(modes.imfs.cols() == 0);
    CHECK((modes.residue - x).isZero(1e-15));
  }
  SECTION("five samples hold three extrema, the least an oscillation has") {
    const Eigen::VectorXd x = test::tone(1, 5, 2);
    const Emd modes = emd(x);
    REQUIRE(modes.imfs.cols() >= 1);
    CHECK((modes.imfs.col(0) - x).cwiseAbs().maxCoeff() < 0.1);
  }
}

TEST_CASE("emd gives the same bits whatever the number of threads", "[analysis][emd][threads]") {
  std::vector<Eigen::VectorXd> x;
  for (unsigned channel = 0; channel < 8; ++channel) x.push_back(test::white_noise(3000, channel));
  std::vector<Emd> modes(x.size());
  parallel_for(
      x.size(), [&](std::size_t i) { modes[i] = emd(x[i]); }, 4);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Emd alone = emd(x[i]);
    CHECK(modes[i].imfs == alone.imfs);
    CHECK(modes[i].residue == alone.residue);
    CHECK(modes[i].unreliable_ends == alone.unreliable_ends);
  }
}

TEST_CASE("emd refuses what it cannot answer", "[analysis][emd][errors]") {
  Eigen::VectorXd x = test::white_noise(100, 7);
  CHECK_THROWS_AS(emd(x, {.imfs = 0}), std::invalid_argument);
  CHECK_THROWS_AS(emd(x, {.sifts = 0}), std::invalid_argument);
  CHECK_THROWS_WITH(emd(x, {.sifts = -2}), "emd: sifts = -2, at least 1");
  x[GENERATE(0, 50, 99)] =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH(emd(x), "emd: sample not finite");
}
