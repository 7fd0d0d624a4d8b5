#include "hal/formats/unwrap_angle.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

namespace rvbench::hal::formats {
namespace {

Eigen::VectorXd turning_by(double step_rad) {
  return Eigen::VectorXd::LinSpaced(1000, 0.3, 0.3 + 999 * step_rad);
}

Eigen::VectorXd wrapped(Eigen::VectorXd angle_rad, double from_rad) {
  for (double& rad : angle_rad) {
    rad -= units::two_pi * std::floor((rad - from_rad) / units::two_pi);
  }
  return angle_rad;
}

}  // namespace

TEST_CASE("an angle that starts anew after each turn is made whole", "[hal][formats]") {
  const double step_rad = GENERATE(0.02, 1.2, -0.02);
  const double from_rad = GENERATE(0.0, -units::two_pi / 2);
  const Eigen::VectorXd whole = turning_by(step_rad);
  Eigen::VectorXd angle = wrapped(whole, from_rad);
  REQUIRE(unwrap_angle(angle));
  CHECK((angle.array() - angle[0]).isApprox(whole.array() - whole[0], 1e-9));
}

TEST_CASE("samples that are lost stay lost", "[hal][formats]") {
  Eigen::VectorXd angle = wrapped(turning_by(0.02), 0);
  angle[300] = not_known;
  REQUIRE(unwrap_angle(angle));
  CHECK(std::isnan(angle[300]));
  CHECK(angle[999] - angle[0] == Approx(999 * 0.02));
}

TEST_CASE("an angle that is whole, goes to and fro or stands is left alone",
          "[hal][formats][null]") {
  Eigen::VectorXd whole = turning_by(0.02);
  Eigen::VectorXd to_and_fro = 3 * turning_by(0.05).array().sin();
  Eigen::VectorXd standing = Eigen::VectorXd::Constant(10, 1.5);
  Eigen::VectorXd fast = wrapped(turning_by(2.5), 0);  // two or three samples a turn may be any speed
  Eigen::VectorXd none;
  for (Eigen::VectorXd* angle : {&whole, &to_and_fro, &standing, &fast, &none}) {
    const Eigen::VectorXd before = *angle;
    CHECK_FALSE(unwrap_angle(*angle));
    CHECK(*angle == before);
  }
}

}  // namespace rvbench::hal::formats
