#pragma once

#include <array>
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

  /// Of two columns: p becomes of_p.re·p + q_to_p·q, and q becomes of_p.im·p + q_to_q·q.
  struct Turn {
    int p = 0;
    int q = 0;
    bool is_none = false;
    Complexes of_p{};
    Complexes q_to_p{};
    Complexes q_to_q{};
  };

  SvdWorkspace(int row_count, int column_count);

  int rows;
  int columns;
  int pairs_per_round;
  std::vector<Complexes> a;        ///< rows x columns: the matrices; then R and the reflectors
  std::vector<Complexes> rotated;  ///< columns x columns: Rᴴ·J = V·diag(s), V's rows as ordered
  std::vector<Complexes> rotations;           ///< columns x columns: J
  std::vector<Complexes> left;                ///< rows x columns: U
  std::vector<Complexes> diagonal;            ///< of R
  std::vector<Complexes> strengths;           ///< of the reflectors, real
  std::vector<Complexes> squares;             ///< squared norms of the columns of `rotated`, real
  std::vector<Complexes> products;            ///< of the pairs of one round
  std::vector<std::array<int, lanes>> order;  ///< with which column k changed places, k = 0, 1 ...
  std::vector<Turn> turns;                    ///< of one sweep, round after round
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
