#pragma once

#include <Eigen/LU>
#include <complex>

#include "hal/types/units.hpp"
#include "sim/robot/virtual_robot.hpp"

namespace rvbench::test {

/// Accelerance of the robot from its matrices, M·s² + C·s + K solved at a point of the Laplace
/// plane, without its modal sum: sensors x paths.
inline Eigen::MatrixXcd direct_accelerance(const sim::VirtualRobot& robot, std::complex<double> s) {
  const sim::Structure& structure = robot.arm().structure;
  const Eigen::MatrixXd mass = sim::mass_matrix(structure);
  const Eigen::MatrixXd shapes = mass * robot.modes().shapes;
  const Eigen::VectorXd damper =
      2 * units::two_pi * robot.modes().damping_ratio.cwiseProduct(robot.modes().frequency_Hz);
  const Eigen::MatrixXd damping = shapes * damper.asDiagonal() * shapes.transpose();
  const Eigen::MatrixXcd dynamic =
      s * s * mass + s * damping + sim::stiffness_matrix(structure).cast<std::complex<double>>();

  Eigen::MatrixXd in(structure.coordinates(), sim::VirtualRobot::paths);
  Eigen::MatrixXd out(sim::VirtualRobot::sensors, structure.coordinates());
  const sim::RobotArm& arm = robot.arm();
  const auto ways = [&](const sim::BodyPoint& point) {
    return Eigen::MatrixXd(sim::motion_of(structure, point).topRows<3>());
  };
  for (Eigen::Index i = 0; i < 6; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    in.middleCols<3>(3 * i) = ways(arm.active[joint]).transpose();
    out.middleRows<3>(3 * i) = ways(arm.active[joint]);
    out.middleRows<3>(18 + 3 * i) = ways(arm.passive[joint]);
  }
  out.middleRows<3>(36) = ways(arm.flange);
  out.middleRows<3>(39) = ways(arm.forearm);
  return s * s * (out * dynamic.partialPivLu().solve(in.cast<std::complex<double>>()));
}

inline std::complex<double> on_axis(double frequency_Hz) {
  return {0, units::two_pi * frequency_Hz};
}

/// The largest difference over the largest value.
template <class A, class B>
double relative_difference(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace rvbench::test
