#pragma once

#include <Eigen/Core>

#include "sim/robot/force_shape.hpp"
#include "sim/robot/modes.hpp"

namespace rvbench::sim {

/// What points accelerate by [m/s²] under forces that have the grid's period: exact at every line.
/// @param forces_N  lines x forces, 0-to-peak  @param at_forces  forces x modes: shapes there
/// @param at_points  points x modes
/// @return lines x points
Eigen::MatrixXcd steady_response(const Modes& modes, const PeriodGrid& grid,
                                 const Eigen::MatrixXcd& forces_N, const Eigen::MatrixXd& at_forces,
                                 const Eigen::MatrixXd& at_points);

/// Accelerance [m/s²/N] of pairs of a force and a point, at lines [first, first + count).
/// @param shape_products  pairs x modes: shape at the force times shape at the point
/// @return count x pairs
Eigen::MatrixXcd pair_accelerance(const Modes& modes, const PeriodGrid& grid, Eigen::Index first,
                                  Eigen::Index count, const Eigen::MatrixXd& shape_products);

/// The first `count` samples of signals that consist of lines of the grid: count x signals.
/// @param lines  grid.lines x signals, 0-to-peak  @param count  at most grid.samples
Eigen::MatrixXd samples_of(const PeriodGrid& grid, const Eigen::MatrixXcd& lines,
                           Eigen::Index count, unsigned threads);

}  // namespace rvbench::sim
