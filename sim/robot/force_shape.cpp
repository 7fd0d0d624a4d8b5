#include "sim/robot/force_shape.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>

#include "sim/robot/virtual_robot.hpp"
#include "sim/robot/white_noise.hpp"

namespace rvbench::sim {
namespace {

constexpr int faulty_joint = 2;  // from 0
constexpr std::array<double, 2> shaft_orders_N{1.5, 0.5};
constexpr std::array<double, 4> family_N{1, 0.5, 0.3, 0.2};
constexpr std::array<double, 3> fault_orders_N{6, 1, 0.5};
constexpr std::array<double, 4> fault_family_N{0.8, 0.5, 0.3, 0.2};
constexpr std::array<double, 2> sidebands{1, 0.5};
constexpr double family_Hz = 100;
constexpr double harmonic_drive_share = 0.4;
constexpr double density_N2_Hz = 0.004;  // at 50 Hz
constexpr double shared_power = 0.4;

// Adds a line to the three forces of one joint.
class JointLines {
 public:
  JointLines(int joint, Draw& draw) : first_path_(3 * joint), draw_(&draw) {}

  void add(ForceShape::Lines& lines, Eigen::Index at, double amplitude_N) {
    if (at <= 0) return;
    auto& forces = lines.try_emplace(at, Eigen::VectorXcd::Zero(VirtualRobot::paths)).first->second;
    for (Eigen::Index path = first_path_; path < first_path_ + 3; ++path) {
      const double magnitude_N = amplitude_N * draw_->within_factor(2);
      forces[path] += std::polar(magnitude_N, draw_->phase_rad());
    }
  }

 private:
  Eigen::Index first_path_;
  Draw* draw_;
};

void add_sound(ForceShape& shape, int joint, Eigen::Index shaft, Eigen::Index family, Draw& draw) {
  JointLines lines(joint, draw);
  const double share = joint >= 4 ? harmonic_drive_share : 1;
  for (std::size_t order = 0; order < shaft_orders_N.size(); ++order) {
    lines.add(shape.sound, Eigen::Index(order + 1) * shaft, shaft_orders_N[order]);
  }
  for (std::size_t harmonic = 0; harmonic < family_N.size(); ++harmonic) {
    lines.add(shape.sound, Eigen::Index(harmonic + 1) * family, share * family_N[harmonic]);
  }
}

void add_fault(ForceShape& shape, Eigen::Index shaft, Eigen::Index family, Draw& draw) {
  JointLines lines(faulty_joint, draw);
  for (std::size_t order = 0; order < fault_orders_N.size(); ++order) {
    lines.add(shape.fault, Eigen::Index(order + 1) * shaft, fault_orders_N[order]);
  }
  for (std::size_t harmonic = 0; harmonic < fault_family_N.size(); ++harmonic) {
    const Eigen::Index centre = Eigen::Index(harmonic + 1) * family;
    for (std::size_t order = 0; order < sidebands.size(); ++order) {
      const Eigen::Index away = Eigen::Index(order + 1) * shaft;
      lines.add(shape.fault, centre - away, fault_family_N[harmonic] * sidebands[order]);
      lines.add(shape.fault, centre + away, fault_family_N[harmonic] * sidebands[order]);
    }
  }
}

}  // namespace

Eigen::Index PeriodGrid::nearest(double frequency_Hz) const {
  return static_cast<Eigen::Index>(std::lround(frequency_Hz / step_Hz));
}

PeriodGrid period_grid(const RobotOptions& options) {
  const auto record = static_cast<std::uint64_t>(std::lround(options.record_s * options.rate_Hz));
  const auto samples = static_cast<Eigen::Index>(std::bit_ceil(record + 1));
  const double step_Hz = options.rate_Hz / static_cast<double>(samples);
  return {samples, step_Hz, static_cast<Eigen::Index>(0.42 * static_cast<double>(samples)) + 1};
}

ForceShape draw_force_lines(RobotMotion motion, const PeriodGrid& grid, Draw& draw) {
  ForceShape shape;
  const RobotMotionCard& card = card_of(motion);
  const Eigen::Index family = grid.nearest(family_Hz);
  for (int joint = 0; joint < robot_joints; ++joint) {
    const Eigen::Index shaft = grid.nearest(card.shaft_Hz[static_cast<std::size_t>(joint)]);
    add_sound(shape, joint, shaft, family, draw);
    if (joint == faulty_joint) add_fault(shape, shaft, family, draw);
  }
  return shape;
}

Eigen::MatrixXcd draw_broadband(const PeriodGrid& grid, Draw& draw) {
  Eigen::ArrayXd amplitude_N(grid.lines);
  for (Eigen::Index k = 0; k < grid.lines; ++k) {
    const double frequency_Hz = std::max(static_cast<double>(k) * grid.step_Hz, 20.0);
    amplitude_N[k] = k == 0 ? 0 : std::sqrt(density_N2_Hz * 50 / frequency_Hz * grid.step_Hz);
  }
  const auto source = [&] {
    Eigen::VectorXd real = Eigen::VectorXd::Zero(grid.lines), imaginary = real;
    add_white_noise(real, 1, draw.seed());
    add_white_noise(imaginary, 1, draw.seed());
    Eigen::ArrayXcd lines(grid.lines);
    lines.real() = real.array() * amplitude_N;
    lines.imag() = imaginary.array() * amplitude_N;
    return lines;
  };
  Eigen::MatrixXcd forces(grid.lines, VirtualRobot::paths);
  for (Eigen::Index joint = 0; joint < robot_joints; ++joint) {
    const Eigen::ArrayXcd shared = source();
    for (Eigen::Index path = 3 * joint; path < 3 * joint + 3; ++path) {
      const std::complex<double> turn = std::polar(std::sqrt(shared_power), draw.phase_rad());
      forces.col(path) = turn * shared + std::sqrt(1 - shared_power) * source();
    }
  }
  return forces;
}

}  // namespace rvbench::sim
