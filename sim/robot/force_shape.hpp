#pragma once

#include <Eigen/Core>
#include <map>

#include "sim/robot/robot_motion.hpp"
#include "sim/robot/robot_options.hpp"

namespace rvbench::sim {

/// Lines of a long period, of which a record is a part: no line of it falls on those of the record.
struct PeriodGrid {
  Eigen::Index samples = 0;  ///< of the period, a power of two
  double step_Hz = 0;
  Eigen::Index lines = 0;  ///< that may carry force: 0 to 0.42 of the sample rate

  Eigen::Index nearest(double frequency_Hz) const;
};

PeriodGrid period_grid(const RobotOptions& options);

/// Forces at the paths, each at unit strength, as lines of the grid: amplitudes 0-to-peak [N],
/// f(t) = Σ Re(F·e^{iωt}).
///
/// Each joint  its input shaft (orders 1, 2) and a 100 Hz family (harmonics 1-4), a harmonic
///             drive's family at 0.4 of the others'; each path within a factor of 2, phases
///             drawn
/// Joint 3     a faulty input shaft adds orders 1-3 of the shaft, order 1 four times that of a
///             sound shaft, and sidebands of first and second order at the family's harmonics
/// Broadband   density 1/f from 20 Hz on, constant below; a joint's three forces share 40 % of
///             their power, those of different joints nothing
/// Leaves out: that speeds waver; forces that act between active and passive side
/// Source      the article's section 4.1 and 5.1 for which lines there are; amplitudes assumed
struct ForceShape {
  using Lines = std::map<Eigen::Index, Eigen::VectorXcd>;  ///< by line of the grid: one a path

  Lines sound;                 ///< of every machine
  Lines fault;                 ///< added by joint 3's faulty input shaft
  Eigen::MatrixXcd broadband;  ///< lines x paths
};

/// Lines alone: no broadband.
ForceShape draw_force_lines(RobotMotion motion, const PeriodGrid& grid, Draw& draw);

/// lines x paths
Eigen::MatrixXcd draw_broadband(const PeriodGrid& grid, Draw& draw);

}  // namespace rvbench::sim
