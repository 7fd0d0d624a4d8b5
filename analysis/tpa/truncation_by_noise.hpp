#pragma once

#include "analysis/tpa/frf_matrix.hpp"
#include "analysis/tpa/regularisation.hpp"

namespace rvbench::analysis {

/// The largest singular value to expect of the errors of a matrix alone: a singular value of the
/// measured matrix that is not above it may be nothing but error.
///
///     max over rows √(Σ variances of a row) + max over columns √(Σ variances of a column)
///
/// which for equal variances v is √v·(√rows + √columns), the edge of their singular values.
///
/// Shape   variances of the elements of one line: rows x columns → one, in units of the matrix
/// Errors  throws std::invalid_argument: a variance that is negative or not finite
/// Limits  takes the errors of different elements as independent: those of noise are, those of a
///         hammer blow's place and direction are not, but mix columns and lower no rank
/// Source  Bandeira & van Handel, Ann. Probab. 44(4), 2479-2506 (2016); equal variances: Davidson &
///         Szarek, Handbook of the Geometry of Banach Spaces 1, 317-366 (2001)
double noise_floor(const Eigen::Ref<const Eigen::MatrixXd>& variances);

/// noise_floor() of each line of a matrix of FRFs, of its `noise`.
/// Errors  throws std::invalid_argument also if that is not known
Eigen::VectorXd noise_floors(const FrfMatrix& frfs);

/// Keeps the singular values above the floor.
/// Errors  throws std::invalid_argument: floor negative or not finite
/// Source  Thite & Thompson, J. Sound Vib. 264(2), 411-431 (2003): rejection by the error of FRFs
Regularisation truncate_by_noise(const Eigen::Ref<const Eigen::VectorXd>& singular_values,
                                 double floor);

}  // namespace rvbench::analysis
