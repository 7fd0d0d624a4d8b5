#include "sim/robot/structure.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "sim/robot/modes.hpp"

using namespace rvbench;
using sim::ground;

namespace {

sim::SixDirections all_six(double way, double turn) {
  sim::SixDirections stiffness;
  stiffness << Eigen::Vector3d::Constant(way), Eigen::Vector3d::Constant(turn);
  return stiffness;
}

// Two bodies of 2 kg in a row along X, springs of `spring` from the ground to the first and from
// there to the second, each at the centre of what it carries.
sim::Structure two_masses(double spring_N_m) {
  const Eigen::Vector3d radii(0.1, 0.1, 0.1);
  sim::Structure structure;
  structure.bodies = {{"a", 2, radii, {0, 0, 0}}, {"b", 2, radii, {0, 0, 0}}};
  structure.joints = {
      {ground, 0, {0, 0, 0}, all_six(spring_N_m, 10), sim::SixDirections::Constant(0.04)},
      {0, 1, {0, 0, 0}, all_six(spring_N_m, 10), sim::SixDirections::Constant(0.04)}};
  return structure;
}

double accelerance_of(const sim::Modes& modes, Eigen::RowVectorXd at, double frequency_Hz) {
  const Eigen::VectorXcd s = Eigen::VectorXcd::Constant(1, {0, units::two_pi * frequency_Hz});
  const Eigen::MatrixXd shape = at * modes.shapes;
  return std::abs(sim::modal_accelerance(modes, s)
                      .row(0)
                      .cwiseProduct(shape.cwiseAbs2().cast<std::complex<double>>())
                      .sum());
}

}  // namespace

TEST_CASE("two equal masses on two equal springs ring at the golden ratio and its inverse",
          "[sim][robot][literature]") {
  const sim::Modes modes = sim::modes_of(two_masses(8000));
  const double alone_Hz = std::sqrt(8000.0 / 2) / units::two_pi;
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const auto modes_at = [&](double frequency_Hz) {
    return ((modes.frequency_Hz.array() / frequency_Hz - 1).abs() < 1e-9).count();
  };
  CHECK(modes_at(alone_Hz / golden) == 3);  // along X, Y and Z
  CHECK(modes_at(alone_Hz * golden) == 3);
  CHECK(modes_at(alone_Hz) == 0);
}

TEST_CASE("a mode loses half of the loss factor that all its springs have", "[sim][robot][law]") {
  const sim::Modes modes = sim::modes_of(two_masses(8000));
  CHECK((modes.damping_ratio.array() - 0.02).abs().maxCoeff() < 1e-12);
}

TEST_CASE("a spring without loss that holds all of a mode's energy damps nothing",
          "[sim][robot][law]") {
  sim::Structure structure = two_masses(8000);
  for (auto& joint : structure.joints) joint.loss_factor.setZero();
  CHECK(sim::modes_of(structure).damping_ratio.maxCoeff() == 0);
}

TEST_CASE("a force on an arm bends its foot by the lever's square", "[sim][robot][law]") {
  // 0.5 m above the joint: 1/k along X and L²/k about Y.
  sim::Structure structure;
  structure.bodies = {{"post", 10, {0.2, 0.2, 0.2}, {0.05, 0.02, 0.3}}};
  structure.joints = {
      {ground, 0, {0, 0, 0}, all_six(2e6, 3e4), sim::SixDirections::Constant(0.02)}};
  const Eigen::RowVectorXd at =
      sim::motion_of(structure, {"top", 0, Eigen::Vector3d(0, 0, 0.5)}).row(0);
  const double by_hand_m_N = 1 / 2e6 + 0.5 * 0.5 / 3e4;

  const Eigen::VectorXd ways = algebra::inverse(sim::stiffness_matrix(structure)) * at.transpose();
  CHECK(at.dot(ways) == Approx(by_hand_m_N).epsilon(1e-10));

  const double slow_Hz = 0.01, omega = units::two_pi * slow_Hz;
  CHECK(accelerance_of(sim::modes_of(structure), at, slow_Hz) ==
        Approx(by_hand_m_N * omega * omega).epsilon(1e-5));
}

TEST_CASE("between soft feet and stiff joints bodies move as one rigid mass", "[sim][robot][law]") {
  sim::Structure structure = two_masses(1e9);
  structure.joints[0].stiffness.setConstant(10);
  const Eigen::RowVectorXd at = sim::motion_of(structure, {"a", 0, {0, 0, 0}}).row(0);
  CHECK(accelerance_of(sim::modes_of(structure), at, 60) == Approx(1 / 4.0).epsilon(1e-3));
}

TEST_CASE("a structure that is not one is refused", "[sim][robot]") {
  sim::Structure structure = two_masses(8000);
  SECTION("nothing holds it") { structure.joints[0].stiffness.setZero(); }
  SECTION("a body without mass") { structure.bodies[1].mass_kg = 0; }
  SECTION("a joint to a body that is not there") { structure.joints[1].to = 2; }
  SECTION("a joint of a body with itself") { structure.joints[1].to = 0; }
  SECTION("a stiffness below 0") { structure.joints[1].stiffness[4] = -1; }
  SECTION("a loss that is no number") {
    structure.joints[1].loss_factor[0] = std::numeric_limits<double>::quiet_NaN();
  }
  CHECK_THROWS_AS(sim::modes_of(structure), std::invalid_argument);
}
