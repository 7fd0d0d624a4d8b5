#pragma once

#include <Eigen/Core>
#include <vector>

#include "hal/types/frequency_response.hpp"
#include "sim/robot/modes.hpp"
#include "sim/robot/robot_arm.hpp"
#include "sim/robot/robot_options.hpp"

namespace rvbench::sim {

/// The arm as those see it who hit and measure it: 18 paths in, 42 sensors out.
///
/// Order of paths    J1 active +X, +Y, +Z, J2 active +X, ... J6 active +Z
/// Order of sensors  36 indicators: J1 to J6 active, then J1 to J6 passive; 3 targets at the
///                   flange; 3 on the forearm for validation; each +X, +Y, +Z
/// Signs             a force is positive if it pushes the structure in the direction named, an
///                   acceleration if the point speeds up in it; e^{+iωt}
class VirtualRobot {
 public:
  static constexpr Eigen::Index paths = 18;
  static constexpr Eigen::Index indicators = 36;
  static constexpr Eigen::Index first_target = indicators;
  static constexpr Eigen::Index targets = 3;
  static constexpr Eigen::Index first_validation = first_target + targets;
  static constexpr Eigen::Index sensors = first_validation + 3;

  /// @throws std::invalid_argument if an option makes no sense
  explicit VirtualRobot(const RobotOptions& options);

  const RobotOptions& options() const { return options_; }
  const RobotArm& arm() const { return arm_; }
  const Modes& modes() const { return modes_; }
  const std::vector<DegreeOfFreedom>& path_places() const { return path_places_; }
  const std::vector<DegreeOfFreedom>& sensor_places() const { return sensor_places_; }

  /// Shapes of the modes at the sensors, sensors x modes; and at the paths, paths x modes: forces
  /// and then moments about X, Y, Z at the same points, as hits beside the point bring.
  const Eigen::MatrixXd& at_sensors() const { return at_sensors_; }
  const Eigen::MatrixXd& at_paths() const { return at_paths_; }
  const Eigen::MatrixXd& at_path_moments() const { return at_path_moments_; }

  /// Exact accelerance (m/s²)/N at one frequency: sensors x paths.
  Eigen::MatrixXcd accelerance(double frequency_Hz) const;

  /// The same over frequency, without noise: sensors x paths of them, sensors of a path in a row.
  /// @throws std::invalid_argument if first_Hz < 0, step_Hz <= 0 or lines < 1
  std::vector<FrequencyResponse> frequency_responses(double first_Hz, double step_Hz,
                                                     Eigen::Index lines) const;

 private:
  RobotOptions options_;
  RobotArm arm_;
  Modes modes_;
  std::vector<DegreeOfFreedom> path_places_, sensor_places_;
  Eigen::MatrixXd at_sensors_, at_paths_, at_path_moments_;
};

}  // namespace rvbench::sim
