#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <cmath>

#include "analysis/tpa/line_matrices.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::test {

/// Complex normal numbers, E|z|² = 1.
inline Eigen::MatrixXcd complex_noise(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  const Eigen::VectorXd parts = white_noise(2 * rows * columns, seed) / std::sqrt(2.);
  const Eigen::Map<const Eigen::VectorXcd> values(
      reinterpret_cast<const std::complex<double>*>(parts.data()), rows * columns);
  return values.reshaped(rows, columns);
}

/// Columns that are orthonormal, and random otherwise.
inline Eigen::MatrixXcd orthonormal(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  const Eigen::HouseholderQR<Eigen::MatrixXcd> qr(complex_noise(rows, columns, seed));
  return qr.householderQ() * Eigen::MatrixXcd::Identity(rows, columns);
}

/// A matrix of these singular values.
inline Eigen::MatrixXcd with_singular_values(const Eigen::VectorXd& s, Eigen::Index rows,
                                             unsigned seed) {
  const Eigen::MatrixXcd left = orthonormal(rows, s.size(), seed);
  const Eigen::MatrixXcd right = orthonormal(s.size(), s.size(), seed + 1);
  return left * s.cast<std::complex<double>>().asDiagonal() * right.adjoint();
}

/// From 1 down to 1/condition, evenly on a logarithmic scale.
inline Eigen::VectorXd graded(Eigen::Index count, double condition) {
  const double least = -std::log(condition);
  return Eigen::VectorXd::LinSpaced(count, 0, least).array().exp();
}

inline analysis::LineMatrices one_line(const Eigen::MatrixXcd& a) {
  analysis::LineMatrices lines(a.rows(), a.cols(), 1);
  lines[0] = a;
  return lines;
}

}  // namespace rvbench::test
