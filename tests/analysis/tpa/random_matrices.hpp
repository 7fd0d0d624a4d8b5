#pragma once

#include <Eigen/Core>

#include "analysis/tpa/line_matrices.hpp"

namespace rvbench::test {

/// Complex normal numbers, E|z|² = 1.
Eigen::MatrixXcd complex_noise(Eigen::Index rows, Eigen::Index columns, unsigned seed);

/// A matrix of these singular values, its vectors random.
Eigen::MatrixXcd with_singular_values(const Eigen::VectorXd& s, Eigen::Index rows, unsigned seed);

/// From 1 down to 1/condition, evenly on a logarithmic scale.
Eigen::VectorXd graded(Eigen::Index count, double condition);

analysis::LineMatrices one_line(const Eigen::MatrixXcd& a);

}  // namespace rvbench::test
