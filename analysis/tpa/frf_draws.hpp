#pragma once

#include <functional>
#include <random>
#include <vector>

#include "analysis/tpa/frf_matrix.hpp"

namespace rvbench::analysis {

/// FRFs as another test of the same structure might have given them.
using FrfDraw = std::function<FrfMatrix(std::mt19937_64&)>;

/// Within their variances; as they are where these are not known.
///
/// A FRF's error has one draw for all lines, each scaled to the line's variance: what makes a
/// hammer's hits differ, place and direction, shifts neighbouring lines alike, and errors that
/// average out over a band would make the result look surer than it is. That errors of different
/// sensors are independent is the cautious guess: it hides paths' differences that hits leave.
///
/// @param frfs  must outlive the draws
/// Units  of the FRFs. Errors  none thrown. Source  definition
FrfDraw draws_within_variances(const FrfMatrix& frfs);

/// Of one column: how each of its hits is off, rows of the matrix x lines. See hit_deviations().
using ColumnDeviations = std::vector<Eigen::MatrixXcf>;

/// By hits drawn with replacement, those of one column apart from those of another. A mean of n
/// hits drawn from n varies by (n - 1)/n of what it should: that is made up for. Of a column with
/// one hit nothing is known, and it stays.
///
/// @param frfs, columns  must outlive the draws; one per column
/// Units   of the FRFs
/// Errors  throws std::invalid_argument: other columns, rows or lines than the FRFs'
/// Source  Davison & Hinkley, Bootstrap Methods and their Application (1997), sec. 2.7, 3.2
FrfDraw draws_of_hits(const FrfMatrix& frfs, const std::vector<ColumnDeviations>& columns);

}  // namespace rvbench::analysis
