#include "analysis/tpa/line_svd.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "hal/types/linear_algebra.hpp"
#include "tests/analysis/tpa/random_matrices.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;
using test::complex_noise, test::graded, test::one_line, test::with_singular_values;

namespace {

double distance_from_orthonormal(const Eigen::MatrixXcd& q) {
  return (q.adjoint() * q - Eigen::MatrixXcd::Identity(q.cols(), q.cols())).cwiseAbs().maxCoeff();
}

void check_is_decomposition(const LineMatrices& a, const LineSvd& svd) {
  for (Index line = 0; line < a.lines; ++line) {
    CAPTURE(line);
    const Eigen::VectorXd s = svd.singular_values.col(line);
    const Eigen::MatrixXcd again =
        svd.left[line] * s.cast<std::complex<double>>().asDiagonal() * svd.right[line].adjoint();
    CHECK((again - a[line]).norm() <= 1e-13 * a[line].norm());
    CHECK(distance_from_orthonormal(svd.left[line]) < 1e-12);
    CHECK(distance_from_orthonormal(svd.right[line]) < 1e-12);
    CHECK(s.minCoeff() >= 0);
    for (Index k = 1; k < s.size(); ++k) CHECK(s[k] <= s[k - 1]);
  }
}

LineMatrices random_lines(Index rows, Index columns, Index lines) {
  LineMatrices a(rows, columns, lines);
  for (Index line = 0; line < lines; ++line) {
    a[line] = complex_noise(rows, columns, unsigned(100 + line));
  }
  return a;
}

}  // namespace

TEST_CASE("singular values are those that a matrix was made of, at any condition",
          "[analysis][tpa]") {
  for (const double condition : {1., 1e3, 1e10, 1e16}) {
    CAPTURE(condition);
    const Eigen::VectorXd s = graded(18, condition);
    const LineMatrices a = one_line(with_singular_values(s, 36, 7));
    const LineSvd svd = line_svd(a, 1);
    CHECK((svd.singular_values.col(0) - s).cwiseAbs().maxCoeff() < 1e-14);
    check_is_decomposition(a, svd);
  }
}

TEST_CASE("the condition of Hilbert's matrix is the one in the books",
          "[analysis][tpa][literature]") {
  Eigen::MatrixXcd hilbert(5, 5);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) hilbert(i, j) = 1. / (i + j + 1);
  }
  const LineSvd svd = line_svd(one_line(hilbert), 1);
  // Higham, Accuracy and Stability of Numerical Algorithms (2nd ed., 2002), table 28.1: 4.77e5.
  CHECK(svd.singular_values(0, 0) / svd.singular_values(4, 0) == Approx(4.77e5).epsilon(1e-3));
}

TEST_CASE("a batch of lines is decomposed as Eigen does each", "[analysis][tpa]") {
  // Not a multiple of the lanes; sizes odd and even, one column, square.
  const auto [rows, columns] =
      GENERATE(table<Index, Index>({{36, 18}, {7, 5}, {9, 1}, {6, 6}, {1, 1}}));
  LineMatrices a = random_lines(rows, columns, 7);
  a[3] *= 1e100;  // each line by itself: neither its unit nor its neighbours matter
  a[4] *= 1e-100;
  const LineSvd svd = line_svd(a, 1);
  check_is_decomposition(a, svd);
  for (Index line = 0; line < a.lines; ++line) {
    if (line == 3 || line == 4) continue;  // Eigen does not scale
    const Eigen::VectorXd eigen = algebra::singular_values(a[line]);
    const Eigen::VectorXd difference = eigen - svd.singular_values.col(line);
    CHECK(difference.cwiseAbs().maxCoeff() < 1e-13 * eigen[0]);
  }
}

TEST_CASE("what has no full rank has orthonormal vectors all the same", "[analysis][tpa]") {
  LineMatrices a = random_lines(10, 4, 6);
  a[0].setZero();
  a[1].col(2).setZero();
  a[2].col(1) = a[2].col(0);
  a[3].setOnes();
  a[4].setZero();
  a[4](5, 2) = {0, 3};
  a[5].col(3) = a[5].col(0) + 1e-14 * a[5].col(3);
  const LineSvd svd = line_svd(a, 1);
  check_is_decomposition(a, svd);
  CHECK(svd.singular_values.col(0).isZero(0));
  CHECK(svd.singular_values(3, 1) == 0);
  CHECK(svd.singular_values(3, 2) < 1e-14 * svd.singular_values(0, 2));
  CHECK(svd.singular_values(0, 3) == Approx(std::sqrt(40.)));
  CHECK(svd.singular_values(1, 3) < 1e-14);
  CHECK(svd.singular_values(0, 4) == Approx(3));
}

TEST_CASE("two columns that are equally long and orthogonal already are left as they are",
          "[analysis][tpa]") {
  const LineSvd svd = line_svd(one_line(Eigen::MatrixXcd::Identity(8, 5)), 1);
  CHECK(svd.singular_values.isOnes(0));
}

TEST_CASE("every processor decomposes alike, with any number of threads", "[analysis][tpa][law]") {
  LineMatrices a = random_lines(36, 18, 70);
  for (Index line = 0; line < 5; ++line) {
    a[line] = with_singular_values(graded(18, 1e10), 36, unsigned(line));
  }
  const LineSvd best = line_svd(a, 1), on_two = line_svd(a, 2);
  CHECK(best.left.values == on_two.left.values);
  CHECK(best.right.values == on_two.right.values);
  const LineSvd portable = line_svd(a, 1, portable_svd_kernels());
  check_is_decomposition(a, portable);
  for (Index line = 0; line < a.lines; ++line) {
    const Eigen::VectorXd difference =
        best.singular_values.col(line) - portable.singular_values.col(line);
    CHECK(difference.cwiseAbs().maxCoeff() < 1e-12 * best.singular_values(0, line));
  }
}

TEST_CASE("what cannot be decomposed is refused", "[analysis][tpa]") {
  CHECK_THROWS_AS(line_svd(random_lines(3, 4, 1)), std::invalid_argument);
  CHECK_THROWS_AS(line_svd(LineMatrices(3, 0, 1)), std::invalid_argument);
  LineMatrices a = random_lines(4, 3, 2);
  a[1](0, 2) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(line_svd(a), std::invalid_argument);
  CHECK(line_svd(LineMatrices(4, 3, 0)).left.lines == 0);
}
