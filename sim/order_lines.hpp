#pragma once

#include <Eigen/Core>

#include "sim/period_orders.hpp"

namespace rvbench::sim {

using Signals = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Signals over one period from their lines, x(t) = X_0 + Re Σ X_k·exp(jkφ), φ = 0 .. 2π, at the
/// samples that tell these orders apart.
/// @param lines  one row for each signal; column 0: the mean, column 1 + i: of orders()[i]
Signals over_period(const Eigen::MatrixXcd& lines, const PeriodOrders& at);

/// The other way.
/// @param signals  at.samples() columns
Eigen::MatrixXcd lines_of(const Signals& signals, const PeriodOrders& at);

}  // namespace rvbench::sim
