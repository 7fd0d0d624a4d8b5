#pragma once

#include "analysis/tpa/line_matrices.hpp"
#include "analysis/tpa/svd_kernels.hpp"

namespace rvbench::analysis {

/// Thin singular value decompositions A = U·diag(s)·Vᴴ, one per line.
struct LineSvd {
  LineMatrices left;                ///< U: rows x columns of A
  Eigen::MatrixXd singular_values;  ///< columns x lines, each column falling, in units of A
  LineMatrices right;               ///< V: columns x columns
};

/// The decompositions of all lines: Householder's QR and one-sided Jacobi, lines side by side.
///
/// Shape    rows x columns of L lines, rows >= columns >= 1 (transpose what is wider than high)
/// Accuracy U and V orthonormal to 1e-12, also where A has no full rank; singular values to 1e-12
///          of the largest; each line scaled by itself, so that its unit does not matter
/// Errors   throws std::invalid_argument: rows < columns, no column, a value that is not finite
/// Threads  up to `threads` (0: the free cores); the result does not depend on them
/// Source   of SvdKernels
LineSvd line_svd(const LineMatrices& a, unsigned threads = 0,
                 const SvdKernels& kernels = svd_kernels());

}  // namespace rvbench::analysis
