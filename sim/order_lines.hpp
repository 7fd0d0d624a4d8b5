#pragma once

#include <Eigen/Core>

namespace rvbench::sim {

using Signals = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Signals over one period from their lines, x(t) = X_0 + Re Σ X_k·exp(jkφ), φ = 0 .. 2π.
/// @param lines    one row for each signal, column k of order k
/// @param samples  more than twice the orders
Signals over_period(const Eigen::MatrixXcd& lines, Eigen::Index samples);

/// The other way: lines 0 .. orders of signals that were sampled over one period.
Eigen::MatrixXcd lines_of(const Signals& signals, Eigen::Index orders);

}  // namespace rvbench::sim
