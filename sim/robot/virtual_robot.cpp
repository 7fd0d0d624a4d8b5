#include "sim/robot/virtual_robot.hpp"

#include <array>

#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

using Complex = std::complex<double>;

constexpr std::array<const char*, 3> directions{"+X", "+Y", "+Z"};

std::vector<DegreeOfFreedom> places_of(const std::vector<BodyPoint>& points) {
  std::vector<DegreeOfFreedom> places;
  for (const BodyPoint& point : points) {
    for (const char* direction : directions) places.push_back({point.name, direction});
  }
  return places;
}

// Three rows a point: of its ways (first = 0) or of its turns (first = 3).
Eigen::MatrixXd shapes_at(const RobotArm& arm, const Modes& modes,
                          const std::vector<BodyPoint>& points, Eigen::Index first) {
  Eigen::MatrixXd shapes(3 * static_cast<Eigen::Index>(points.size()), modes.count());
  Eigen::Index row = 0;
  for (const BodyPoint& point : points) {
    shapes.middleRows<3>(row) = motion_of(arm.structure, point).middleRows<3>(first) * modes.shapes;
    row += 3;
  }
  return shapes;
}

RobotArm arm_of(const RobotOptions& options) {
  require_sound(options);
  return make_robot_arm(draw_for(options, "arm"), options.stiffness_spread);
}

}  // namespace

VirtualRobot::VirtualRobot(const RobotOptions& options)
    : options_(options), arm_(arm_of(options)), modes_(modes_of(arm_.structure)) {
  const std::vector<BodyPoint> active(arm_.active.begin(), arm_.active.end());
  std::vector<BodyPoint> all = active;
  all.insert(all.end(), arm_.passive.begin(), arm_.passive.end());
  all.push_back(arm_.flange);
  all.push_back(arm_.forearm);
  path_places_ = places_of(active);
  sensor_places_ = places_of(all);
  at_sensors_ = shapes_at(arm_, modes_, all, 0);
  at_paths_ = shapes_at(arm_, modes_, active, 0);
  at_path_moments_ = shapes_at(arm_, modes_, active, 3);
}

Eigen::MatrixXcd VirtualRobot::accelerance(double frequency_Hz) const {
  const Eigen::VectorXcd s = Eigen::VectorXcd::Constant(1, {0, units::two_pi * frequency_Hz});
  const Eigen::VectorXcd gain = modal_accelerance(modes_, s).transpose();
  const Eigen::MatrixXcd scaled = at_sensors_.cast<Complex>() * gain.asDiagonal();
  return scaled * at_paths_.transpose();
}

std::vector<FrequencyResponse> VirtualRobot::frequency_responses(double first_Hz, double step_Hz,
                                                                 Eigen::Index lines) const {
  constexpr Require require{"VirtualRobot::frequency_responses"};
  require(first_Hz >= 0 && step_Hz > 0 && lines >= 1,
          "needs first_Hz >= 0, step_Hz > 0, lines >= 1");
  Eigen::VectorXcd s = Eigen::VectorXcd::Zero(lines);
  s.imag() = Eigen::VectorXd::LinSpaced(lines, first_Hz, first_Hz + step_Hz * double(lines - 1)) *
             units::two_pi;
  const Eigen::MatrixXcd gain = modal_accelerance(modes_, s);
  std::vector<FrequencyResponse> responses;
  for (Eigen::Index path = 0; path < paths; ++path) {
    const Eigen::MatrixXcd values =
        gain * (at_sensors_ * at_paths_.row(path).asDiagonal()).transpose();
    for (Eigen::Index sensor = 0; sensor < sensors; ++sensor) {
      responses.push_back({"virtual robot, exact",
                           sensor_places_[std::size_t(sensor)],
                           path_places_[std::size_t(path)],
                           "m/s²",
                           "N",
                           first_Hz,
                           step_Hz,
                           values.col(sensor),
                           {},
                           0,
                           {}});
    }
  }
  return responses;
}

}  // namespace rvbench::sim
