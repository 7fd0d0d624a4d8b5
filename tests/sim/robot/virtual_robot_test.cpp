#include "sim/robot/virtual_robot.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "hal/types/linear_algebra.hpp"
#include "tests/sim/robot/direct_solution.hpp"

using namespace rvbench;
using sim::VirtualRobot;
using test::relative_difference;

namespace {

VirtualRobot robot_of(std::uint64_t seed) {
  sim::RobotOptions options;
  options.seed = seed;
  return VirtualRobot(options);
}

double condition_at(const VirtualRobot& robot, double frequency_Hz) {
  const Eigen::VectorXd sizes =
      algebra::singular_values(robot.accelerance(frequency_Hz).topRows(VirtualRobot::indicators));
  return sizes[0] / sizes[sizes.size() - 1];
}

}  // namespace

TEST_CASE("the robot's mass and stiffness are symmetric and positive definite",
          "[sim][robot][law]") {
  const VirtualRobot robot = robot_of(GENERATE(range(1u, 4u)));
  for (const Eigen::MatrixXd& matrix :
       {sim::mass_matrix(robot.arm().structure), sim::stiffness_matrix(robot.arm().structure)}) {
    CHECK(relative_difference(matrix.transpose(), matrix) < 1e-15);
    CHECK(algebra::hermitian_eigenvalues(matrix.cast<std::complex<double>>()).minCoeff() > 0);
  }
}

TEST_CASE("the arm sways between 8 and 25 Hz, rings up to 2 kHz and loses 1 to 4 % in each mode",
          "[sim][robot]") {
  const sim::Modes modes = robot_of(GENERATE(range(1u, 21u))).modes();
  CHECK(modes.frequency_Hz[0] > 8);
  CHECK(modes.frequency_Hz[2] < 25);
  CHECK(modes.frequency_Hz.tail(1)[0] > 1500);
  CHECK(modes.frequency_Hz.tail(1)[0] < 2400);
  CHECK(modes.damping_ratio.minCoeff() > 0.01);
  CHECK(modes.damping_ratio.maxCoeff() < 0.04);
}

TEST_CASE("the modal sum is what mass, damping and stiffness give when solved", "[sim][robot]") {
  const VirtualRobot robot = robot_of(3);
  const double frequency_Hz = GENERATE(1.0, 11.0, 97.3, 640.0, 2000.0);
  CHECK(relative_difference(robot.accelerance(frequency_Hz),
                            test::direct_accelerance(robot, test::on_axis(frequency_Hz))) < 1e-8);
}

TEST_CASE("hitting here and listening there is hitting there and listening here",
          "[sim][robot][law]") {
  const Eigen::MatrixXcd active = robot_of(4).accelerance(GENERATE(9.0, 130.0, 1500.0)).topRows(18);
  CHECK(relative_difference(active.transpose(), active) < 1e-12);
}

TEST_CASE("whatever forces act on the active sides, the robot only takes power",
          "[sim][robot][law]") {
  // P = Re(f*·v)/2 and v = a/(iω): the imaginary part of accelerance must be positive definite.
  const Eigen::MatrixXd imaginary =
      robot_of(5).accelerance(GENERATE(2.0, 10.0, 12.2, 110.0, 700.0)).topRows(18).imag();
  const Eigen::MatrixXd symmetric = (imaginary + imaginary.transpose()) / 2;
  const Eigen::VectorXd powers =
      algebra::hermitian_eigenvalues(symmetric.cast<std::complex<double>>());
  CHECK(imaginary.diagonal().minCoeff() > 0);
  CHECK(powers.minCoeff() > -1e-12 * powers.maxCoeff());
}

TEST_CASE("far above all modes a gear answers as the free body that it is", "[sim][robot][law]") {
  const VirtualRobot robot = robot_of(6);
  const Eigen::MatrixXcd far = robot.accelerance(1e6);
  for (std::size_t joint = 0; joint < 6; ++joint) {
    const sim::BodyPoint& point = robot.arm().active[joint];
    const sim::RigidBody& gear = robot.arm().structure.bodies[std::size_t(point.body)];
    const Eigen::Vector3d r = point.at_m - gear.centre_m,
                          inertia = gear.mass_kg * gear.gyration_m.cwiseAbs2();
    const double by_hand =
        1 / gear.mass_kg + r.z() * r.z() / inertia.y() + r.y() * r.y() / inertia.z();
    const auto along_x = static_cast<Eigen::Index>(3 * joint);
    CHECK(far(along_x, along_x).real() == Approx(by_hand).epsilon(1e-4));
  }
}

TEST_CASE(
    "where passive sides move together the paths can hardly be told apart, elsewhere they can",
    "[sim][robot]") {
  const VirtualRobot robot = robot_of(GENERATE(range(1u, 6u)));
  double worst = 0;
  for (double frequency_Hz = 8; frequency_Hz < 14; frequency_Hz += 0.1) {
    worst = std::max(worst, condition_at(robot, frequency_Hz));
  }
  CHECK(worst > 1e3);
  CHECK(condition_at(robot, 400) < 50);
  CHECK(condition_at(robot, 1000) < 50);
}

TEST_CASE("ready FRFs are the robot's, each with place, direction and unit", "[sim][robot]") {
  const VirtualRobot robot = robot_of(7);
  const auto responses = robot.frequency_responses(5, 2.5, 40);
  REQUIRE(responses.size() == 42U * 18U);
  const FrequencyResponse& one = responses[42 * 6 + 37];
  CHECK(one.excitation == DegreeOfFreedom{"J3 active", "+X"});
  CHECK(one.response == DegreeOfFreedom{"flange", "+Y"});
  CHECK(one.response_unit == "m/s²");
  CHECK(one.excitation_unit == "N");
  CHECK(std::abs(one.values[20] - robot.accelerance(55)(37, 6)) < 1e-12 * std::abs(one.values[20]));
  CHECK_THROWS_AS(robot.frequency_responses(0, 0, 10), std::invalid_argument);
}

TEST_CASE("a seed is one robot, another seed another, and without spread all are alike",
          "[sim][robot]") {
  CHECK((robot_of(8).modes().frequency_Hz == robot_of(8).modes().frequency_Hz));
  CHECK((robot_of(8).modes().frequency_Hz != robot_of(9).modes().frequency_Hz));
  sim::RobotOptions one, two;
  one.stiffness_spread = two.stiffness_spread = 0;
  two.seed = 2;
  CHECK(test::relative_difference(VirtualRobot(one).modes().frequency_Hz,
                                  VirtualRobot(two).modes().frequency_Hz) == 0);
}

TEST_CASE("options that make no sense are refused by name", "[sim][robot]") {
  sim::RobotOptions options;
  SECTION("no hits") { options.hits = 0; }
  SECTION("a rate below the forces") { options.rate_Hz = 500; }
  SECTION("noise below 0") { options.sensor_noise = -0.01; }
  SECTION("no record") { options.record_s = 0; }
  SECTION("a spread that leaves no robot") { options.stiffness_spread = 0.9; }
  CHECK_THROWS_AS(VirtualRobot(options), std::invalid_argument);
}
