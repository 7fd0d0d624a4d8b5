#pragma once

#include <Eigen/Core>
#include <complex>

#include "sim/robot/structure.hpp"

namespace rvbench::sim {

/// The undamped modes of a structure, each with damping of its own.
///
/// Damping  by the share of a mode's strain energy that each spring holds and its loss factor:
///          ζ = Σ η·(its energy) / (2·Σ energy), so that ζ lies between the least and the largest
///          η/2. Leaves out: that damping couples the modes (shapes stay real).
/// Source   Ewins, Modal Testing, 2nd ed., §2.4; damping: Johnson & Kienholz, AIAA J. 20(9),
///          1284-1290 (1982)
struct Modes {
  Eigen::VectorXd frequency_Hz;   ///< m values, ascending
  Eigen::VectorXd damping_ratio;  ///< m values
  Eigen::MatrixXd shapes;         ///< n x m, mass-normalised: 1/√kg

  Eigen::Index count() const { return frequency_Hz.size(); }
};

/// @throws std::invalid_argument if the structure is not sound, or moves without any spring giving
Modes modes_of(const Structure& structure);

/// Accelerance of each mode per unit of its modal force, s²/(s² + 2ζω·s + ω²), at points of the
/// Laplace plane (s = 2πi·f for a frequency): points x m.
Eigen::MatrixXcd modal_accelerance(const Modes& modes, const Eigen::VectorXcd& s_per_s);

}  // namespace rvbench::sim
