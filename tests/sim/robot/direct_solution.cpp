#include "tests/sim/robot/direct_solution.hpp"

#include "hal/types/linear_algebra.hpp"

namespace rvbench::test {

Eigen::MatrixXcd direct_accelerance(const sim::VirtualRobot& robot, std::complex<double> s) {
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
  return s * s *
         (out *
          algebra::ComplexLu(dynamic).solve(Eigen::MatrixXcd(in.cast<std::complex<double>>())));
}

}  // namespace rvbench::test
