#pragma once

#include <vector>

#include "analysis/tpa/frf_matrix.hpp"

namespace rvbench::analysis {

/// What smoothing makes of a line: the sum of `of_window` times the lines from `first` on;
/// of_window is empty where the line stays as it was.
struct LineSmoothing {
  Eigen::Index first = 0;
  Eigen::RowVectorXcd of_window;
};

/// FRFs with less noise, and how they came to it.
struct SmoothedFrfs {
  FrfMatrix frfs;
  std::vector<LineSmoothing> lines;  ///< of all elements alike; empty: all stay
};

/// Takes noise out of FRFs: at each line the value there of a rational function of frequency that
/// fits its neighbours, all elements of the matrix sharing one denominator as they share their
/// poles.
///
///     H_ij(f) ≈ N_ij(x) / D(x),  x = (f - f_line) / 12 lines,  N of degree 5, D of degree 4
///
/// over the 25 lines about each, fitted with D made linear and the lines weighted by 1/|D| of the
/// fit before. Elements are weighted by their noise, which fourth differences along the lines tell.
/// What the fit leaves over is the noise: `noise` is set, and `variances`, where they are known,
/// keep what hits differed by alike at neighbouring lines and lose what was smoothed away.
///
/// A line whose remainder is twice what the noise is elsewhere keeps its measured values: its
/// surroundings have more poles than D.
///
/// Shape   that of the matrix. Fewer than 25 lines are returned as they are, `noise` unset
/// Units   those of the matrix
/// Errors  throws std::invalid_argument: a value that is not finite
/// Threads up to `threads` (0: the free cores); the result does not depend on them
/// Limits  five or more resonances within 25 lines; noise that is alike at neighbouring lines stays
/// Source  McKelvey & Guérin, IFAC Proc. Vol. 45(16), 716-721 (2012); Sanathanan & Koerner, IEEE
///         Trans. Autom. Control 8(1), 56-58 (1963)
SmoothedFrfs smooth_frfs(FrfMatrix frfs, unsigned threads = 0);

/// Does to other elements what was done to the FRFs.
/// Shape   any number x lines of the smoothing. Units  of the elements
/// Errors  throws std::invalid_argument: other lines. Source  of smooth_frfs(): linear once poles
///         are known
Eigen::MatrixXcf smoothed_alike(const Eigen::MatrixXcf& elements,
                                const std::vector<LineSmoothing>& lines);

}  // namespace rvbench::analysis
