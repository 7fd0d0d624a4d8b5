#include "tests/analysis/tpa/random_matrices.hpp"

#include <cmath>

#include "hal/types/linear_algebra.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::test {

Eigen::MatrixXcd complex_noise(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  const Eigen::VectorXd parts = white_noise(2 * rows * columns, seed) / std::sqrt(2.);
  const Eigen::Map<const Eigen::VectorXcd> values(
      reinterpret_cast<const std::complex<double>*>(parts.data()), rows * columns);
  return values.reshaped(rows, columns);
}

Eigen::MatrixXcd with_singular_values(const Eigen::VectorXd& s, Eigen::Index rows, unsigned seed) {
  const Eigen::MatrixXcd left = algebra::orthonormal_columns(complex_noise(rows, s.size(), seed));
  const Eigen::MatrixXcd right =
      algebra::orthonormal_columns(complex_noise(s.size(), s.size(), seed + 1));
  return left * s.cast<std::complex<double>>().asDiagonal() * right.adjoint();
}

Eigen::VectorXd graded(Eigen::Index count, double condition) {
  const double least = -std::log(condition);
  return Eigen::VectorXd::LinSpaced(count, 0, least).array().exp();
}

analysis::LineMatrices one_line(const Eigen::MatrixXcd& a) {
  analysis::LineMatrices lines(a.rows(), a.cols(), 1);
  lines[0] = a;
  return lines;
}

}  // namespace rvbench::test
