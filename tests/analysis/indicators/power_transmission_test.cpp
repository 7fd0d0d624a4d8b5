#include "analysis/indicators/power_transmission.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/signals.hpp"

using namespace rvbench::analysis;
using rvbench::test::tone;

TEST_CASE("a torque that swings by a about T ripples by 2a/T, whichever way it turns",
          "[analysis][indicators]") {
  const Eigen::VectorXd torque_Nm = 5 + 0.4 * tone(10, 1000, 1000).array();
  CHECK(*torque_ripple(torque_Nm) == Approx(2 * 0.4 / 5));
  CHECK(*torque_ripple(-torque_Nm) == Approx(2 * 0.4 / 5));
  CHECK(*torque_ripple(Eigen::VectorXd::Constant(3, 5)) == 0);
}

TEST_CASE("no mean torque, no ripple, no torque throws", "[analysis][indicators]") {
  CHECK_FALSE(torque_ripple(Eigen::VectorXd::Zero(10)));
  CHECK_THROWS_AS(torque_ripple(Eigen::VectorXd()), std::invalid_argument);
}

TEST_CASE("the mean power of two that swing together is more than the product of their means",
          "[analysis][indicators]") {
  const Eigen::VectorXd swing = tone(10, 1000, 1000);
  const Eigen::VectorXd torque_Nm = 5 + 2 * swing.array();
  const Eigen::VectorXd speed_rad_s = 100 + 3 * swing.array();
  CHECK(mean_power_W(torque_Nm, speed_rad_s) == Approx(500 + 2 * 3 / 2.0));
  CHECK(mean_power_W(-torque_Nm, speed_rad_s) == Approx(-503));
  CHECK_THROWS_AS(mean_power_W(torque_Nm, speed_rad_s.head(5)), std::invalid_argument);
}

TEST_CASE("efficiency is of who drives whom", "[analysis][indicators]") {
  // An RV-20E at 15 rpm and 167 N·m: 262 W leave it.
  CHECK(*efficiency(327.9, 262.3) == Approx(0.8).epsilon(1e-3));
  CHECK(*efficiency(-262.3, -327.9) == Approx(0.8).epsilon(1e-3));
  CHECK(*efficiency(100, 101) == Approx(1.01));  // the sensors disagree, and are shown to
}

TEST_CASE("where both sides only brake there is no efficiency", "[analysis][indicators]") {
  CHECK_FALSE(efficiency(10, -5));
  CHECK_FALSE(efficiency(0, 0));
  CHECK_FALSE(efficiency(10, 0));
  CHECK_FALSE(efficiency(std::nan(""), 5));
}
