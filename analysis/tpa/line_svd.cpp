#include "analysis/tpa/line_svd.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "analysis/tpa/line_jobs.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Complex = std::complex<double>;
using Order = std::vector<Index>;

constexpr Index lanes = SvdWorkspace::lanes;
// Of what is scaled to 1 at most: below, squares are no more what they should be.
constexpr double no_square = 1e-280;

class Job {
 public:
  Job(const LineMatrices& a, const SvdKernels& kernels, LineSvd& svd)
      : a_(a), kernels_(kernels), svd_(svd), w_(int(a.rows), int(a.columns)) {}

  void decompose(Index from, Index to) {
    for (Index first = from; first < to; first += lanes) {
      const Index count = std::min(lanes, to - first);
      // Those that are too many repeat the last line.
      for (Index lane = 0; lane < lanes; ++lane) pack(lane, std::min(first + lane, to - 1));
      if (!kernels_.decompose(w_)) {
        throw std::logic_error("line_svd: no convergence at lines from " + std::to_string(first));
      }
      for (Index lane = 0; lane < count; ++lane) unpack(lane);
    }
  }

 private:
  [[noreturn]] static void refuse(Index line) {
    throw std::invalid_argument("line_svd: a value of line " + std::to_string(line) +
                                " is not finite");
  }

  void pack(Index lane, Index line) {
    const Complex* from = a_.values.data() + line * a_.rows * a_.columns;
    const Index count = a_.rows * a_.columns;
    const Eigen::Map<const Eigen::ArrayXd> parts(reinterpret_cast<const double*>(from), 2 * count);
    const double largest = parts.abs().maxCoeff<Eigen::PropagateNaN>();
    if (!std::isfinite(largest)) refuse(line);
    line_[lane] = line;
    // A power of two, so that nothing is rounded.
    scale_[lane] = largest > 0 ? std::exp2(std::ilogb(largest)) : 1;
    const double inverse = 1 / scale_[lane];
    for (Index i = 0; i < count; ++i) {
      w_.a[std::size_t(i)].re[lane] = inverse * from[i].real();
      w_.a[std::size_t(i)].im[lane] = inverse * from[i].imag();
    }
  }

  void unpack(Index lane) {
    const Index n = a_.columns, m = a_.rows;
    Order rows(std::size_t(n), 0);  // of A's columns, as pivoting left them
    std::iota(rows.begin(), rows.end(), 0);
    for (Index k = 0; k < n; ++k) {
      std::swap(rows[std::size_t(k)],
                rows[std::size_t(w_.order[std::size_t(k)][std::size_t(lane)])]);
    }
    const Order order = by_norm(lane);
    for (Index k = 0; k < n; ++k) {
      const Index from = order[std::size_t(k)];
      const double square = w_.squares[std::size_t(from)].re[lane];
      const double norm = square > no_square ? std::sqrt(square) : 0;
      const double inverse = norm > 0 ? 1 / norm : 0;
      svd_.singular_values(k, line_[lane]) = norm * scale_[lane];
      Complex* left = svd_.left.values.data() + (line_[lane] * n + k) * m;
      for (Index row = 0; row < m; ++row) {
        const auto& z = w_.left[std::size_t(from * m + row)];
        left[row] = {z.re[lane], z.im[lane]};
      }
      Complex* right = svd_.right.values.data() + (line_[lane] * n + k) * n;
      for (Index row = 0; row < n; ++row) {
        const auto& z = w_.rotated[std::size_t(from * n + row)];
        right[rows[std::size_t(row)]] = {z.re[lane] * inverse, z.im[lane] * inverse};
      }
      if (norm == 0) complete(svd_.right[line_[lane]], k);
    }
  }

  // Columns of what was rotated, by falling norm.
  Order by_norm(Index lane) const {
    Order order(std::size_t(a_.columns));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) {
      return w_.squares[std::size_t(i)].re[lane] > w_.squares[std::size_t(j)].re[lane];
    });
    return order;
  }

  // Column k becomes a unit vector orthogonal to those before: of unit vectors the one that is
  // farthest from them, less what it has of them (twice, for rounding).
  static void complete(Eigen::Map<Eigen::MatrixXcd> right, Index k) {
    Index farthest = 0;
    right.leftCols(k).rowwise().squaredNorm().minCoeff(&farthest);
    Eigen::VectorXcd v = Eigen::VectorXcd::Unit(right.rows(), farthest);
    for (int pass = 0; pass < 2; ++pass) {
      v -= right.leftCols(k) * (right.leftCols(k).adjoint() * v).eval();
    }
    right.col(k) = v.normalized();
  }

  const LineMatrices& a_;
  const SvdKernels& kernels_;
  LineSvd& svd_;
  SvdWorkspace w_;
  Index line_[lanes] = {};
  double scale_[lanes] = {};  // what A was divided by
};

}  // namespace

LineSvd line_svd(const LineMatrices& a, unsigned threads, const SvdKernels& kernels) {
  constexpr Require require{"line_svd"};
  require(a.columns >= 1, "no columns");
  require(a.rows >= a.columns, std::to_string(a.rows) + " rows are fewer than " +
                                   std::to_string(a.columns) + " columns");
  require(a.values.size() == a.rows * a.columns * a.lines, "values do not fill the matrices");
  LineSvd svd{LineMatrices::unset(a.rows, a.columns, a.lines), Eigen::MatrixXd(a.columns, a.lines),
              LineMatrices::unset(a.columns, a.columns, a.lines)};
  for_line_stretches(
      a.lines, [&](Index from, Index to) { Job(a, kernels, svd).decompose(from, to); }, threads);
  return svd;
}

}  // namespace rvbench::analysis
