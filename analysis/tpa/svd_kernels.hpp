#pragma once

#include <complex>
#include <vector>

namespace rvbench::analysis {

/// Room for the decompositions of a few matrices of one size, side by side.
struct SvdWorkspace {
  static constexpr int lanes = 4;
  struct Complexes {
    alignas(32) double re[lanes];
    alignas(32) double im[lanes];
  };

  SvdWorkspace(int row_count, int column_count);

  int rows;
  int columns;
  std::vector<Complexes> a;          ///< rows x columns: the matrices; then reflectors
  std::vector<Complexes> rotated;    ///< 2·columns x columns: V·diag(s), and below it J
  std::vector<Complexes> left;       ///< rows x columns: U
  std::vector<Complexes> diagonal;   ///< of R
  std::vector<Complexes> strengths;  ///< of the reflectors, real
  std::vector<Complexes> squares;    ///< squared norms of the columns of `rotated`, real
};

/// The inner loops of singular value decompositions, for one kind of processor. The kinds agree to
/// rounding: one fuses products with sums.
/// Units   those of the matrices. Errors  none thrown
/// Source  Demmel & Veselić, SIAM J. Matrix Anal. Appl. 13(4), 1204-1245 (1992): one-sided Jacobi;
///         Drmač & Veselić, ibid. 29(4), 1322-1342 (2008): on the triangle's transpose
struct SvdKernels {
  /// From w.a makes w.left, w.rotated and w.squares. Columns come in no order.
  /// @return false if some lane has not converged within the sweeps that are enough for any matrix
  bool (*decompose)(SvdWorkspace& w);

  /// inverse = V·diag(weights)·Uᴴ, columns x rows. `right` holds V (columns x kept), `left` U
  /// (rows x kept), column by column; `scratch` has room for 4·columns·kept.
  void (*invert)(const std::complex<double>* left, const std::complex<double>* right,
                 const double* weights, int rows, int columns, int kept, double* scratch,
                 std::complex<double>* inverse);
};

/// For any processor.
const SvdKernels& portable_svd_kernels();
/// For this one.
const SvdKernels& svd_kernels();

}  // namespace rvbench::analysis
