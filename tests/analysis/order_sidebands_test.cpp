#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/order/sidebands.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Modulation;
using analysis::Sidebands;
using analysis::sidebands_of;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr int per_turn = 128;
constexpr double turns = 484.0;
constexpr double carrier = 1080.0 / 121;

// A carrier of amplitude 2 that swings, away from every line's middle.
struct Swinging {
  double am = 0, am_order = 39.5 / 121, pm = 0, pm_order = 1.0037, noise = 0;
  unsigned seed = 1;

  analysis::OverAngle signal() const {
    const auto n = static_cast<Eigen::Index>(turns * per_turn);
    const Eigen::ArrayXd theta = two_pi * test::times_s(n, per_turn);
    Eigen::VectorXd x = 2 * (1 + am * (am_order * theta + 0.4).cos()) *
                        (carrier * theta + pm * (pm_order * theta - 1).cos()).cos();
    x += noise * test::white_noise(n, seed);
    return {x, per_turn, 0};
  }
  Sidebands found() const { return sidebands_of(signal(), {carrier, 4}); }
};

const Modulation& at(const Sidebands& found, double spacing) {
  for (const Modulation& m : found.modulations) {
    if (std::abs(m.spacing - spacing) < 0.5 / turns) return m;
  }
  FAIL("no modulation at " << spacing);
  return found.modulations.front();
}

}  // namespace

TEST_CASE("a swing of the amplitude is told as such, and where it is", "[analysis][order][law]") {
  const double depth = GENERATE(0.01, 0.3, 0.9);
  const Sidebands found = Swinging{.am = depth, .noise = 0.002}.found();
  CAPTURE(depth);
  CHECK(found.carrier_order == Approx(carrier).margin(0.02 / turns));
  CHECK(found.carrier_amplitude == Approx(2).epsilon(1e-3));
  const Modulation& swing = at(found, 39.5 / 121);
  CHECK(swing.spacing == Approx(39.5 / 121).margin(0.05 / turns));
  CHECK(swing.am_depth == Approx(depth).epsilon(5e-3));
  CHECK(swing.pm_index_rad < std::max(4 * swing.pm_error_rad, 1e-3 * depth));
  CHECK(swing.lower == Approx(depth).epsilon(1e-2));  // half of the depth of 2
  CHECK(swing.upper == Approx(depth).epsilon(1e-2));
}

TEST_CASE("a swing of the phase is told as such, however deep", "[analysis][order][law]") {
  // By its sidebands alone, J1(1.5) / J0(1.5) = 1.09, it would look like half of that.
  const double index_rad = GENERATE(0.02, 0.5, 1.5);
  const Sidebands found = Swinging{.pm = index_rad, .pm_order = 0.2541, .noise = 0.002}.found();
  CAPTURE(index_rad);
  const Modulation& swing = at(found, 0.2541);
  CHECK(swing.pm_index_rad == Approx(index_rad).epsilon(5e-3));
  CHECK(swing.am_depth < std::max(4 * swing.am_error, 1e-3 * index_rad));
  CHECK_FALSE(found.first_order);
  CHECK(swing.upper == Approx(2 * std::abs(std::cyl_bessel_j(1, index_rad))).epsilon(1e-2));
}

TEST_CASE("both at once are parted, each at its own spacing", "[analysis][order]") {
  const Sidebands found = Swinging{.am = 0.2, .pm = 0.3, .noise = 0.01}.found();
  CHECK(at(found, 39.5 / 121).am_depth == Approx(0.2).epsilon(0.02));
  CHECK(at(found, 39.5 / 121).pm_p_value == 1);
  CHECK(at(found, 1.0037).pm_index_rad == Approx(0.3).epsilon(0.02));
  CHECK(at(found, 1.0037).am_p_value == 1);
}

TEST_CASE("both at one spacing make sidebands unequal", "[analysis][order][law]") {
  // In quadrature the upper sideband is A/2·(m + β), the lower A/2·|m − β|, to first order.
  const auto n = static_cast<Eigen::Index>(turns * per_turn);
  const Eigen::ArrayXd theta = two_pi * test::times_s(n, per_turn);
  const Eigen::VectorXd x =
      2 * (1 + 0.05 * (0.3 * theta).cos()) * (carrier * theta + 0.05 * (0.3 * theta).sin()).cos() +
      0.001 * test::white_noise(n, 1).array();
  const Sidebands found = sidebands_of({x, per_turn, 0}, {carrier, 4});
  const Modulation& swing = at(found, 0.3);
  CHECK(swing.am_depth == Approx(0.05).epsilon(0.01));
  CHECK(swing.pm_index_rad == Approx(0.05).epsilon(0.01));
  CHECK(swing.upper == Approx(0.1).epsilon(0.02));
  CHECK(swing.lower < 0.005);
}

TEST_CASE("harmonics of a swing are called so", "[analysis][order]") {
  // A burst once per 2.5 turns: cos² has its fundamental and the second harmonic.
  const auto n = static_cast<Eigen::Index>(turns * per_turn);
  const Eigen::ArrayXd theta = two_pi * test::times_s(n, per_turn);
  const Eigen::ArrayXd swing = 0.2 * (0.4 * theta).cos() + 0.1 * (0.8 * theta).cos();
  const Eigen::VectorXd x =
      (1 + swing) * (carrier * theta).cos() + 0.005 * test::white_noise(n, 2).array();
  const Sidebands found = sidebands_of({x, per_turn, 0}, {carrier, 4});
  CHECK(at(found, 0.4).multiple == 1);
  CHECK(at(found, 0.8).multiple == 2);
  CHECK(found.modulations[0].spacing == Approx(0.4).margin(0.1 / turns));
}

TEST_CASE("a line that fades under its sidebands is told to first order", "[analysis][order]") {
  const Sidebands found = Swinging{.am = 1.6, .noise = 0.01}.found();
  CHECK(found.first_order);
  CHECK(found.carrier_order == Approx(carrier).margin(0.05 / turns));
  CHECK(at(found, 39.5 / 121).am_depth == Approx(1.6).epsilon(0.02));
  CHECK(at(found, 39.5 / 121).pm_index_rad < 0.05);
}

TEST_CASE("a steady carrier has no sidebands", "[analysis][order][null]") {
  // At 1e-3 for each: more than 2 of 40 once in 100 000 choices of seeds.
  std::size_t swings = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    swings += Swinging{.noise = 0.3, .seed = seed}.found().modulations.size();
  }
  CHECK(swings <= 2);
  CHECK(Swinging{}.found().modulations.empty());
}

TEST_CASE("where no carrier is, nothing is told", "[analysis][order][null]") {
  int carriers = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto n = static_cast<Eigen::Index>(turns * per_turn);
    const Sidebands found = sidebands_of({test::white_noise(n, seed), per_turn, 0}, {carrier, 4});
    carriers += found.carrier_order > 0;
    CHECK(found.modulations.size() <= (found.carrier_order > 0 ? 99u : 0u));
  }
  CHECK(carriers <= 2);
}

TEST_CASE("a band that is not there is refused", "[analysis][order]") {
  const auto x = Swinging{}.signal();
  CHECK_THROWS_AS(sidebands_of(x, {carrier, 10}), std::invalid_argument);
  CHECK_THROWS_AS(sidebands_of(x, {63, 4}), std::invalid_argument);
  CHECK_THROWS_AS(sidebands_of(x, {carrier, 0.05}), std::invalid_argument);
  CHECK_THROWS_AS(sidebands_of({}, {carrier, 4}), std::invalid_argument);
}
