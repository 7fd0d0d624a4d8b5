#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

/// Eigen's products and decompositions of matrices of any size, compiled once in the algebra_*.cpp
/// files beside this header. A decomposition takes seconds to compile in every file that names its
/// type; one of a small fixed size does not. Each family has a file of its own, so that two
/// processors compile them and none takes half a minute.
///
/// Errors  shapes must agree, and a matrix must be what its function asks for: a violation is a
///         caller's bug, which the presets with Eigen's checks (asan, tsan) report
/// Source  Golub & Van Loan, Matrix Computations (4th ed., 2013)
namespace rvbench::algebra {

/// A·B
Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& a,
                        const Eigen::Ref<const Eigen::MatrixXd>& b);
Eigen::MatrixXcd product(const Eigen::Ref<const Eigen::MatrixXcd>& a,
                         const Eigen::Ref<const Eigen::MatrixXcd>& b);

/// Aᵀ·A
Eigen::MatrixXd gram(const Eigen::Ref<const Eigen::MatrixXd>& a);

/// LU with partial pivots of a square matrix. Copies share it.
class ComplexLu {
 public:
  explicit ComplexLu(const Eigen::MatrixXcd& a);
  Eigen::VectorXcd solve(const Eigen::VectorXcd& b) const;
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& b) const;
  double reciprocal_condition() const;  ///< 0 of a singular matrix

 private:
  std::shared_ptr<const Eigen::PartialPivLU<Eigen::MatrixXcd>> factors_;
};

/// By LU with partial pivots. The matrix is square and not singular.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);

/// By LU with full pivots.
/// @returns nothing for a singular matrix
std::optional<Eigen::MatrixXd> inverse_if_regular(const Eigen::MatrixXd& a);

/// By LU with full pivots. A singular matrix gives infinities or NaN.
Eigen::MatrixXcd inverse_by_full_pivots(const Eigen::MatrixXcd& a);
Eigen::VectorXcd solve_by_full_pivots(const Eigen::MatrixXcd& a, const Eigen::VectorXcd& b);

/// LDLᵀ of a symmetric matrix that has no negative eigenvalue; of another one the results mean
/// nothing. Copies share it.
class SymmetricFactors {
 public:
  explicit SymmetricFactors(const Eigen::MatrixXd& a);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  Eigen::MatrixXd inverse() const;
  double log_determinant() const;

 private:
  std::shared_ptr<const Eigen::LDLT<Eigen::MatrixXd>> factors_;
};

/// The inverse of a Hermitian, positive definite matrix, by LLᴴ; of another one it means nothing.
Eigen::MatrixXcd inverse_of_positive(const Eigen::MatrixXcd& a);

/// QR with column pivots: the x with the least |A·x − b|. Copies share it.
class ComplexLeastSquares {
 public:
  explicit ComplexLeastSquares(const Eigen::MatrixXcd& a);
  Eigen::VectorXcd solve(const Eigen::VectorXcd& b) const;

 private:
  std::shared_ptr<const Eigen::ColPivHouseholderQR<Eigen::MatrixXcd>> factors_;
};

/// The X with the least |A·X − B|, by QR without pivots. A has full rank.
Eigen::MatrixXcd least_squares(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// As many orthonormal columns as A has, which span the same, by QR without pivots.
Eigen::MatrixXcd orthonormal_columns(const Eigen::MatrixXcd& a);

/// As many orthonormal columns as A's rank, which span the same, by QR with column pivots. A pivot
/// counts as 0 below the largest pivot times the lesser dimension times the machine's epsilon.
Eigen::MatrixXd basis_of_columns(const Eigen::MatrixXd& a);
Eigen::Index rank(const Eigen::MatrixXd& a);

/// Complete orthogonal decomposition: of all x with the least |A·x − b| the shortest. Copies share
/// it.
class MinimumNorm {
 public:
  explicit MinimumNorm(const Eigen::MatrixXd& a);
  /// @param threshold  pivots below this share of the largest count as 0
  MinimumNorm(const Eigen::MatrixXd& a, double threshold);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd pseudo_inverse() const;

 private:
  std::shared_ptr<const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> factors_;
};

/// The eigenvalues of a square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXcd& a);

struct EigenPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< a column each
};
EigenPairs eigen_pairs(const Eigen::MatrixXd& a);

/// The eigenvalues of a Hermitian matrix, from the least on.
Eigen::VectorXd hermitian_eigenvalues(const Eigen::MatrixXcd& a);
Eigen::MatrixXcd hermitian_eigenvectors(const Eigen::MatrixXcd& a);

struct SymmetricPairs {
  Eigen::VectorXd values;   ///< from the least on
  Eigen::MatrixXd vectors;  ///< a column each, with vectorᵀ·B·vector = 1
};
/// A·vector = value·B·vector, A symmetric, B symmetric and positive definite.
/// @returns nothing if the iteration does not converge
std::optional<SymmetricPairs> generalised_pairs(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The singular values, from the largest on, by Jacobi's method.
Eigen::VectorXd singular_values(const Eigen::MatrixXcd& a);

struct RightSingular {
  Eigen::VectorXd values;   ///< from the largest on
  Eigen::MatrixXd vectors;  ///< a column each
};
RightSingular right_singular(const Eigen::MatrixXd& a);

/// exp(A) of a square matrix, by a Padé approximant with scaling and squaring.
Eigen::MatrixXd exponential(const Eigen::MatrixXd& a);

}  // namespace rvbench::algebra
