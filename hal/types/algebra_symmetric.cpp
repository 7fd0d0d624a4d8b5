#include <Eigen/Eigenvalues>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::algebra {

Eigen::VectorXd hermitian_eigenvalues(const Eigen::MatrixXcd& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::MatrixXcd hermitian_eigenvectors(const Eigen::MatrixXcd& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(a).eigenvectors();
}

std::optional<SymmetricPairs> generalised_pairs(const Eigen::MatrixXd& a,
                                                const Eigen::MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricPairs{solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace rvbench::algebra
