#include <catch2/catch.hpp>

#include "analysis/emd/emd.hpp"
#include "tests/support/signals.hpp"

// Rato, Mendes & Batista, Mech. Syst. Signal Process. 22(6), 1374-1394 (2008): what a
// decomposition must not depend on.

using namespace rvbench;
using analysis::Emd;
using analysis::emd;

namespace {

Eigen::VectorXd gear_like() {
  const Eigen::VectorXd carrier =
      test::ringing({.carrier_Hz = 237, .rate_Hz = 15, .depth = 0.4}, 9920, 4960);
  return carrier + 0.25 * test::white_noise(9920, 8) + test::tone(3.3, 9920, 4960, 0.5);
}

double largest_difference(const Emd& a, const Emd& b) {
  REQUIRE(a.imfs.cols() == b.imfs.cols());
  CHECK(a.unreliable_ends == b.unreliable_ends);
  return (a.imfs - b.imfs).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("the unit does not change the modes", "[analysis][emd][law]") {
  const Eigen::VectorXd x = gear_like();
  const Emd modes = emd(x);
  REQUIRE(modes.imfs.cols() == 9);
  for (const double scale : {1e-6, 9.80665, 1e6, -1.0, 1e-200}) {
    CAPTURE(scale);
    Emd scaled = emd(scale * x);
    scaled.imfs /= scale;
    CHECK(largest_difference(scaled, modes) < 1e-11);
    CHECK((scaled.residue / scale - modes.residue).cwiseAbs().maxCoeff() < 1e-11);
  }
  CHECK(emd(1024 * x).imfs == 1024 * modes.imfs);  // a power of two does not even round
}

TEST_CASE("an offset goes to the residue", "[analysis][emd][law]") {
  const Eigen::VectorXd x = gear_like();
  const Emd modes = emd(x);
  for (const double offset : {-0.3, 100.0, 1e6}) {
    CAPTURE(offset);
    const Emd moved = emd(x.array() + offset);
    // The sum x + offset itself is rounded to this, and each of the 90 sifts may pass it on.
    const double rounding = std::max(1.0, std::abs(offset)) * 1e-16;
    CHECK(largest_difference(moved, modes) < 1e4 * rounding);
    CHECK((moved.residue.array() - offset - modes.residue.array()).abs().maxCoeff() <
          1e4 * rounding);
  }
}

TEST_CASE("time reversed, the modes are reversed", "[analysis][emd][law]") {
  const Eigen::VectorXd x = gear_like();
  Emd reversed = emd(x.reverse());
  reversed.imfs = reversed.imfs.colwise().reverse().eval();
  CHECK(largest_difference(reversed, emd(x)) < 1e-11);
}

TEST_CASE("a coarse converter does not move the envelopes by more than a step", "[analysis][emd]") {
  // Its steps make plateaus at the crests: a rule that wants strict inequality would lose those.
  // One sift only: what is left of the steps after it is a fast mode of its own.
  const Eigen::VectorXd x = test::tone(3.3, 9920, 4960, 0.5) + 0.2 * test::tone(40, 9920, 4960);
  constexpr double step = 0.01;
  const Eigen::VectorXd quantised = (x.array() / step).round() * step;
  const auto envelope_mean = [](const Eigen::VectorXd& signal) {
    return Eigen::VectorXd(emd(signal, {.imfs = 1, .sifts = 1}).residue);
  };
  CHECK((envelope_mean(quantised) - envelope_mean(x)).cwiseAbs().maxCoeff() < step);
}
