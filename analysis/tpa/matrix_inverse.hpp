#pragma once

#include <vector>

#include "analysis/tpa/on_board_validation.hpp"
#include "analysis/tpa/regularisation_rule.hpp"
#include "analysis/tpa/sensor_roles.hpp"

namespace rvbench::analysis {

/// Forces at the paths, and what each path makes each target do: phasors, line by line and block by
/// block. It holds the score at sensors that it was not fitted to; there is none without.
struct PathContributions {
  std::vector<DegreeOfFreedom> paths, targets;
  LineGrid grid;
  LineMatrices forces;            ///< paths x blocks, in the unit of excitation, 0-to-peak
  LineMatrices target_frfs;       ///< targets x paths
  LineMatrices measured_targets;  ///< targets x blocks
  OnBoardValidation validation;
  std::vector<Regularisation> rules;  ///< one per line: kept singular values, parameter; empty
                                      ///< where nothing was inverted
  Eigen::VectorXd conditions;         ///< one per line, of the FRFs to weighted indicators; empty
                                      ///< where none were inverted
  std::vector<bool> is_used;          ///< one per line; forces of the others are 0
  Eigen::MatrixXd force_noise;        ///< paths x lines: mean square of what noise adds to a force
  std::vector<DegreeOfFreedom> inputs;  ///< sensors that forces are found from
  LineMatrices to_forces;               ///< paths x inputs: forces = to_forces · inputs

  /// What each path adds to a target at a line: paths x blocks, 0-to-peak, in the target's unit.
  Eigen::MatrixXcd partial(Eigen::Index line, Eigen::Index target) const {
    return target_frfs[line].row(target).transpose().asDiagonal() * forces[line];
  }
  /// The sum over the paths: targets x blocks.
  Eigen::MatrixXcd synthesised(Eigen::Index line) const { return target_frfs[line] * forces[line]; }
};

/// Transfer path analysis by the inverse of the matrix of FRFs to indicators:
///
///     F = H⁺·A         forces from indicators' accelerations, H⁺ regularised line by line
///     P_tp = H_tp·F_p  partial contributions, complex; their sum over p is the target
///
/// Indicators are weighted by 1 / RMS over the used lines: the errors of a loud sensor are larger.
/// What they show beyond the reach of all paths, per degree of freedom, is the noise that the
/// inverse carries into the forces; 0 where there are as many paths as indicators.
///
/// @param frfs       all sensors (rows) per path (columns)
/// @param operating  all sensors
/// @param is_used    one per line, empty for all: those left out count nowhere
/// Shape   lines of the FRFs, blocks of the spectra
/// Units   forces in the unit of excitation
/// Errors  throws std::invalid_argument: other lines or unit than the FRFs', a sensor that is not
///         there, fewer indicators than paths, is_used of another length, a rule that needs
///         the FRFs' noise where that is not known (its floor is then NaN)
/// Threads up to `threads` (0: the free cores); the result does not depend on them
/// Source  van der Seijs, de Klerk & Rixen, Mech. Syst. Signal Process. 68-69, 217-244 (2016),
///         sec. 3.3; Thite & Thompson, J. Sound Vib. 264(2), 411-431 (2003)
PathContributions matrix_inverse_contributions(
    const FrfMatrix& frfs, const OperatingSpectra& operating, const SensorRoles& roles,
    const RegularisationRule& rule, std::vector<bool> is_used = {}, unsigned threads = 0);

/// The same inverse over some of its blocks, in this order; one may be there twice. Validation
/// stays that of all. Shape   of the whole, as many blocks. Units  of the whole Errors  throws
/// std::invalid_argument of a block that is not there. Source  definition
PathContributions over_blocks(PathContributions whole, const std::vector<Eigen::Index>& blocks);

}  // namespace rvbench::analysis
