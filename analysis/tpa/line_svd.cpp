#include "analysis/tpa/line_svd.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Order = std::vector<Index>;

constexpr Index lanes = SvdWorkspace::lanes;
constexpr Index lines_per_job = 64;
// Of what is scaled to 1 at most: below, squares are no more what they should be.
constexpr double no_square = 1e-280;

// Columns by falling norm: Jacobi takes fewer sweeps then.
Order by_norm(const Eigen::Ref<const Eigen::VectorXd>& squares) {
  Order order(std::size_t(squares.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) { return squares[i] > squares[j]; });
  return order;
}

struct Lane {
  Index line = 0;
  Order order;       // of the columns of A
  double scale = 1;  // what A was divided by: its largest part
};

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
  void pack(Index lane, Index line) {
    const auto from = a_[line];
    Lane& of = lanes_[lane];
    of.line = line;
    const double largest = std::max(from.real().cwiseAbs().maxCoeff(), from.imag().cwiseAbs().maxCoeff());
    of.scale = largest > 0 ? largest : 1;
    of.order = by_norm((from / of.scale).colwise().squaredNorm().transpose());
    for (Index column = 0; column < a_.columns; ++column) {
      const auto source = from.col(of.order[std::size_t(column)]);
      for (Index row = 0; row < a_.rows; ++row) {
        SvdWorkspace::Complexes& to = w_.a[std::size_t(column * a_.rows + row)];
        to.re[lane] = source[row].real() / of.scale;
        to.im[lane] = source[row].imag() / of.scale;
      }
    }
  }

  void unpack(Index lane) {
    const Index n = a_.columns;
    const Lane& of = lanes_[lane];
    Eigen::VectorXd squares(n);
    for (Index k = 0; k < n; ++k) squares[k] = w_.squares[std::size_t(k)].re[lane];
    const Order order = by_norm(squares);
    auto left = svd_.left[of.line];
    auto right = svd_.right[of.line];
    for (Index k = 0; k < n; ++k) {
      const Index from = order[std::size_t(k)];
      const double square = squares[from];
      const double norm = square > no_square ? std::sqrt(square) : 0;
      const double inverse = norm > 0 ? 1 / norm : 0;
      svd_.singular_values(k, of.line) = norm * of.scale;
      for (Index row = 0; row < a_.rows; ++row) {
        const auto& z = w_.left[std::size_t(from * a_.rows + row)];
        left(row, k) = {z.re[lane], z.im[lane]};
      }
      for (Index row = 0; row < n; ++row) {
        const auto& z = w_.rotated[std::size_t(from * 2 * n + row)];
        right(of.order[std::size_t(row)], k) = {z.re[lane] * inverse, z.im[lane] * inverse};
      }
      if (norm == 0) complete(right, k);
    }
  }

  // Column k becomes a unit vector orthogonal to those before: of unit vectors the one that is
  // farthest from them, less what it has of them (twice, for rounding).
  static void complete(Eigen::Map<Eigen::MatrixXcd>& right, Index k) {
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
  Lane lanes_[lanes];
};

}  // namespace

LineSvd line_svd(const LineMatrices& a, unsigned threads, const SvdKernels& kernels) {
  constexpr Require require{"line_svd"};
  require(a.columns >= 1, "no columns");
  require(a.rows >= a.columns, std::to_string(a.rows) + " rows are fewer than " +
                                   std::to_string(a.columns) + " columns");
  require(a.values.size() == a.rows * a.columns * a.lines, "values do not fill the matrices");
  require(a.values.allFinite(), "a value is not finite");
  LineSvd svd{{a.rows, a.columns, a.lines}, Eigen::MatrixXd::Zero(a.columns, a.lines),
              {a.columns, a.columns, a.lines}};
  const Index jobs = (a.lines + lines_per_job - 1) / lines_per_job;
  parallel_for(
      std::size_t(jobs),
      [&](std::size_t job) {
        const Index from = Index(job) * lines_per_job;
        Job(a, kernels, svd).decompose(from, std::min(a.lines, from + lines_per_job));
      },
      threads);
  return svd;
}

}  // namespace rvbench::analysis
