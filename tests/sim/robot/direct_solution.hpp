#pragma once

#include <Eigen/Core>
#include <complex>

#include "hal/types/units.hpp"
#include "sim/robot/virtual_robot.hpp"

namespace rvbench::test {

/// Accelerance of the robot from its matrices, M·s² + C·s + K solved at a point of the Laplace
/// plane, without its modal sum: sensors x paths.
Eigen::MatrixXcd direct_accelerance(const sim::VirtualRobot& robot, std::complex<double> s);

inline std::complex<double> on_axis(double frequency_Hz) {
  return {0, units::two_pi * frequency_Hz};
}

/// The largest difference over the largest value.
template <class A, class B>
double relative_difference(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace rvbench::test
