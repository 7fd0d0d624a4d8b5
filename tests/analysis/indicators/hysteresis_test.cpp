#include "analysis/indicators/hysteresis.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/support/signals.hpp"

using rvbench::analysis::Hysteresis;
using rvbench::analysis::hysteresis;

namespace {

using Catch::Matchers::Contains;

constexpr double rated_Nm = 100;
constexpr double stiffness = 2000;  // N·m per unit of torsion: rated torque at 0.05
constexpr double clearance = 0.01;

// Torsion from the middle to one end, then `branches` times from end to end.
Eigen::VectorXd to_and_fro(double reach, int branches, Eigen::Index per_branch = 1000) {
  Eigen::VectorXd torsion(per_branch / 2 + branches * per_branch);
  for (Eigen::Index i = 0; i < torsion.size(); ++i) {
    const double way = std::fmod(2.0 * double(i) / double(per_branch), 4.0);
    torsion[i] = reach * (way < 1 ? way : way < 3 ? 2 - way : way - 4);
  }
  return torsion;
}

// A spring with play, and friction against the way it goes.
Eigen::VectorXd torque_of(const Eigen::VectorXd& torsion, double friction_Nm,
                          double play = clearance) {
  Eigen::VectorXd torque(torsion.size());
  for (Eigen::Index i = 0; i < torsion.size(); ++i) {
    const double before = i > 0 ? torsion[i - 1] : -torsion[1];
    const double spring = stiffness * (torsion[i] - std::clamp(torsion[i], -play / 2, play / 2));
    torque[i] = spring + std::copysign(friction_Nm, torsion[i] - before);
  }
  return torque;
}

Hysteresis of_spring(double reach, double friction_Nm, int branches = 4) {
  const Eigen::VectorXd torsion = to_and_fro(reach, branches);
  return hysteresis(torque_of(torsion, friction_Nm), torsion, rated_Nm);
}

}  // namespace

SCENARIO("a loop tells clearance, spring and friction apart", "[analysis][indicators]") {
  for (const double friction_Nm : {1.0, 10.0}) {  // below 3 % of the rated torque, and far above
    GIVEN("a spring with play, and friction of " + std::to_string(friction_Nm)) {
      const Hysteresis told = of_spring(0.07, friction_Nm);
      THEN("the lost motion is the play, and what yields under 3 % to each side") {
        REQUIRE(told.lost_motion_rad);
        CHECK(told.lost_motion_rad->value ==
              Approx(clearance + 2 * 0.03 * rated_Nm / stiffness).epsilon(0.01));
      }
      THEN("the stiffness is the spring's") {
        REQUIRE(told.stiffness_Nm_per_rad);
        CHECK(told.stiffness_Nm_per_rad->value == Approx(stiffness).epsilon(1e-3));
      }
      THEN("the width is the play, and what yields under the friction to each side") {
        REQUIRE(told.width_rad);
        CHECK(told.width_rad->value ==
              Approx(clearance + 2 * friction_Nm / stiffness).epsilon(0.02));
      }
      THEN("nothing is left untold") { CHECK(told.cannot_tell.empty()); }
    }
  }
  GIVEN("a spring without play or friction") {
    const Eigen::VectorXd torsion = to_and_fro(0.06, 4);
    const Hysteresis told = hysteresis(torque_of(torsion, 0, 0), torsion, rated_Nm);
    THEN("the lost motion is what yields, and the loop has no width") {
      REQUIRE(told.lost_motion_rad);
      CHECK(told.lost_motion_rad->value == Approx(0.003).epsilon(0.01));
      CHECK(told.width_rad->value == Approx(0).margin(1e-5));
    }
  }
}

SCENARIO("a reducer that is turned at its output is told by the same loop",
         "[analysis][indicators]") {
  // Hysteresis loss inside the reducer: the branches lie apart in torsion, by less than 3 % of the
  // rated torque, as in the makers' test.
  const Eigen::VectorXd torsion = to_and_fro(0.06, 4);
  Eigen::VectorXd torque = torque_of(torsion, 2, 0);
  const Hysteresis told = hysteresis(torque, torsion, rated_Nm);
  REQUIRE(told.lost_motion_rad);
  // Their mean of the torsions at one torque: both branches are off by 2/stiffness, each its way.
  CHECK(told.lost_motion_rad->value == Approx(2 * 3 / stiffness).epsilon(0.01));
}

TEST_CASE("the interval of a value is that of repeated loops", "[analysis][indicators]") {
  const Eigen::VectorXd torsion = to_and_fro(0.07, 20);
  const Eigen::VectorXd noise = rvbench::test::white_noise(torsion.size(), 3);
  const Hysteresis told = hysteresis(torque_of(torsion, 5) + 0.5 * noise, torsion, rated_Nm);
  REQUIRE(told.loops.size() == 10);
  REQUIRE(told.stiffness_Nm_per_rad);
  CHECK(told.stiffness_Nm_per_rad->error > 0);
  CHECK(told.stiffness_Nm_per_rad->error < 0.02 * stiffness);
  CHECK(std::abs(told.stiffness_Nm_per_rad->value - stiffness) <
        2 * told.stiffness_Nm_per_rad->error);
  CHECK(told.lost_motion_rad->value == Approx(0.013).epsilon(0.05));

  AND_THEN("one loop has a value, and no interval") {
    const Hysteresis once = of_spring(0.07, 5, 2);
    REQUIRE(once.lost_motion_rad);
    CHECK(std::isnan(once.lost_motion_rad->error));
  }
}

SCENARIO("what a loop does not reach is not told", "[analysis][indicators]") {
  GIVEN("a loop to 75 % of the rated torque") {
    const Hysteresis told = of_spring(clearance / 2 + 0.0375, 5);
    THEN("there is a lost motion, and no stiffness") {
      CHECK(told.lost_motion_rad);
      CHECK_FALSE(told.stiffness_Nm_per_rad);
      REQUIRE(told.cannot_tell.size() == 1);
      CHECK_THAT(told.cannot_tell.front(), Contains("reaches 7") && Contains("100 % are needed"));
    }
  }
  GIVEN("a torque that friction alone takes beyond 3 %") {
    const Hysteresis told = of_spring(clearance / 2 + 0.001, 10);
    THEN("there is nothing") {
      CHECK_FALSE(told.lost_motion_rad);
      CHECK_FALSE(told.width_rad);
      REQUIRE_FALSE(told.cannot_tell.empty());
      CHECK_THAT(told.cannot_tell.front(), Contains("does not reach ±3 %"));
    }
  }
  GIVEN("a shaft that is wound one way only") {
    const Eigen::VectorXd torsion = Eigen::VectorXd::LinSpaced(1000, -0.07, 0.07);
    const Hysteresis told = hysteresis(torque_of(torsion, 5), torsion, rated_Nm);
    THEN("there is no loop") {
      CHECK(told.loops.empty());
      REQUIRE_FALSE(told.cannot_tell.empty());
      CHECK_THAT(told.cannot_tell.front(), Contains("to and fro"));
    }
  }
  GIVEN("nothing at all") {
    const Eigen::VectorXd none;
    CHECK_FALSE(hysteresis(none, none, rated_Nm).lost_motion_rad);
  }
}

SCENARIO("loops that cannot be trusted are left out, and why is said", "[analysis][indicators]") {
  GIVEN("branches of a few samples") {
    const Eigen::VectorXd torsion = to_and_fro(0.07, 4, 30);
    const Hysteresis told = hysteresis(torque_of(torsion, 5), torsion, rated_Nm);
    CHECK_FALSE(told.lost_motion_rad);
    REQUIRE_FALSE(told.cannot_tell.empty());
    CHECK_THAT(told.cannot_tell.front(), Contains("samples"));
  }
  GIVEN("an output that slips at the ends of each way") {
    const Eigen::VectorXd way = to_and_fro(0.09, 4);
    Eigen::VectorXd torque = torque_of(way.cwiseMin(0.06).cwiseMax(-0.06), 0);
    const Hysteresis told = hysteresis(torque, way, rated_Nm);
    CHECK_FALSE(told.lost_motion_rad);
    REQUIRE_FALSE(told.cannot_tell.empty());
    CHECK_THAT(told.cannot_tell.front(), Contains("slips"));
  }
  GIVEN("an output that creeps on") {
    Eigen::VectorXd torsion = to_and_fro(0.07, 4);
    const Eigen::VectorXd torque = torque_of(torsion, 5);
    torsion += Eigen::VectorXd::LinSpaced(torsion.size(), 0, 0.04);
    const Hysteresis told = hysteresis(torque, torsion, rated_Nm);
    CHECK_FALSE(told.lost_motion_rad);
    REQUIRE_FALSE(told.cannot_tell.empty());
    CHECK_THAT(told.cannot_tell.front(), Contains("does not close"));
  }
  GIVEN("an output that runs away") {
    Eigen::VectorXd torsion = to_and_fro(0.07, 4);
    const Eigen::VectorXd torque = torque_of(torsion, 5);
    torsion += Eigen::VectorXd::LinSpaced(torsion.size(), 0, 0.27);
    const Hysteresis told = hysteresis(torque, torsion, rated_Nm);
    CHECK_FALSE(told.lost_motion_rad);
    REQUIRE_FALSE(told.cannot_tell.empty());
    CHECK_THAT(told.cannot_tell.front(), Contains("has turned"));
  }
  GIVEN("an angle that is read in steps of a third of the lost motion") {
    const Eigen::VectorXd torsion = to_and_fro(0.07, 4);
    const double step = 0.013 / 3;
    const Eigen::VectorXd read = (torsion / step).array().floor() * step;
    const Hysteresis told = hysteresis(torque_of(torsion, 5), read, rated_Nm);
    CHECK_FALSE(told.lost_motion_rad);
    REQUIRE_FALSE(told.cannot_tell.empty());
    CHECK_THAT(told.cannot_tell.front(), Contains("too coarse"));
    THEN("the stiffness, over the whole way, is told all the same") {
      REQUIRE(told.stiffness_Nm_per_rad);
      CHECK(told.stiffness_Nm_per_rad->value == Approx(stiffness).epsilon(0.05));
    }
  }
}

TEST_CASE("a clearance that takes almost all of the way leaves no stiffness, and why is said",
          "[analysis][indicators]") {
  // From half to full load the spring yields by 0.025, of a way of 7.5: less than a point of 201.
  const Eigen::VectorXd torsion = to_and_fro(3.75, 4, 100000);
  const Hysteresis told = hysteresis(torque_of(torsion, 1, 7.2), torsion, rated_Nm);
  REQUIRE(told.lost_motion_rad);
  CHECK(told.lost_motion_rad->value == Approx(7.2).epsilon(0.01));
  CHECK_FALSE(told.stiffness_Nm_per_rad);
  REQUIRE(told.cannot_tell.size() == 1);
  CHECK_THAT(told.cannot_tell[0], Contains("torsional stiffness") && Contains("clearance"));
}

TEST_CASE("hysteresis() refuses what is no test", "[analysis][indicators]") {
  const Eigen::VectorXd torsion = to_and_fro(0.07, 2);
  Eigen::VectorXd torque = torque_of(torsion, 5);
  CHECK_THROWS_AS(hysteresis(torque, torsion.head(5), rated_Nm), std::invalid_argument);
  CHECK_THROWS_AS(hysteresis(torque, torsion, 0), std::invalid_argument);
  torque[7] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(hysteresis(torque, torsion, rated_Nm), std::invalid_argument);
}
