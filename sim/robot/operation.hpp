#pragma once

#include <Eigen/Core>
#include <vector>

#include "hal/types/recording.hpp"
#include "sim/robot/force_shape.hpp"
#include "sim/robot/path_ranking.hpp"
#include "sim/robot/robot_motion.hpp"
#include "sim/robot/virtual_robot.hpp"

namespace rvbench::sim {

/// A line of the forces: phasors, x(t) = Re(X·e^{iωt}) with t = 0 at the record's first sample.
struct TrueLine {
  double frequency_Hz = 0;
  Eigen::VectorXcd forces_N;      ///< one a path, 0-to-peak
  Eigen::MatrixXcd partial_m_s2;  ///< paths x targets: what each path adds to each target
};

/// What only a test may know of an operation.
struct OperationTruth {
  PathRanking ranking;       ///< as drawn, with the fault in place
  double band_first_Hz = 5;  ///< the analysed band, over which paths are ranked
  double band_last_Hz = 500;
  Eigen::MatrixXd forces_N;          ///< samples x paths, of the record
  Eigen::MatrixXd partial_rms_m_s2;  ///< paths x targets: RMS of partial responses over the band
  std::vector<TrueLine> lines;       ///< ascending; their forces hold also what broadband is there
  PeriodGrid grid;                   ///< the forces' period, longer than the record
  Eigen::MatrixXcd spectrum_N;       ///< grid.lines x paths, 0-to-peak
};

struct Operation {
  Recording recording;  ///< 42 channels named by point, with direction, m/s², sensor noise on them
  OperationTruth truth;
};

/// The robot in steady motion: forces at its paths, accelerations at its sensors.
///
/// Strengths of the paths are solved for so that the article's leaders lead (see path_ranking.hpp),
/// each ahead of the second by 10-30 %, drawn. With joint 3 replaced the strengths are those
/// before. Exact: forces have a period longer than the record, each line answers by its FRF; there
/// is no start and no step. Errors  std::runtime_error if no draw of 60 can be ranked: a specimen
/// beyond what was thought of
Operation operate(const VirtualRobot& robot, RobotMotion motion);

/// What each path alone makes a target do, over the record: samples x paths, m/s², all frequencies.
/// @param target  0 to 2
Eigen::MatrixXd partial_histories(const VirtualRobot& robot, const OperationTruth& truth,
                                  Eigen::Index target);

}  // namespace rvbench::sim
