#pragma once

#include <vector>

#include "analysis/tpa/on_board_validation.hpp"
#include "analysis/tpa/regularisation_rule.hpp"
#include "analysis/tpa/sensor_roles.hpp"

namespace rvbench::analysis {

/// Whether so many references moved in as many independent ways as there are: if not, what they
/// hand on is shared out by least norm, and says little of one alone. Units  none. Errors  none
/// thrown. Source  half a way of tolerance: ours
inline bool tells_all(double ways, Eigen::Index references) {
  return ways > double(references) - 0.5;
}

/// What each reference sensor hands on to each target, as operation alone tells it.
struct OperationalPaths {
  std::vector<DegreeOfFreedom> references, targets;
  LineMatrices transmissibilities;    ///< targets x references
  LineMatrices measured_references;   ///< references x blocks of the record it was learnt from
  std::vector<Regularisation> rules;  ///< per line: principal components kept, parameter
  OnBoardValidation held_out;         ///< targets in blocks that nothing was learnt from
  Eigen::VectorXd ways;  ///< per line: in how many independent ways references moved, as the rule
                         ///< takes them: Σ s·weight(s) over singular values within 40 dB of the
                         ///< largest; what is below is sensors' noise

  /// What each reference adds to a target at a line: references x blocks, 0-to-peak.
  Eigen::MatrixXcd partial(Eigen::Index line, Eigen::Index target) const {
    return transmissibilities[line].row(target).transpose().asDiagonal() *
           measured_references[line];
  }
  bool tells_all(Eigen::Index line) const {
    return analysis::tells_all(ways[line], measured_references.rows);
  }
};

/// Operational transfer path analysis: no force, no hammer.
///
///     Y = T·X,  Xᴴ = U·S·Vᴴ,  Tᴴ = V·S⁺·Uᴴ·Yᴴ     X: references, Y: targets, a column per block
///
/// References are weighted by 1 / RMS: a quiet one near its source is none the less. The SVD
/// cancels cross-talk between them; the rule says which principal components are noise, by
/// truncation, or damps them, after Tikhonov.
///
/// @param learnt    blocks to learn from: as many as references at least, better several times as
///                  many, of operation that varies (run-up, load)
/// @param held_out  blocks of another time, same lines: its score is the analysis' validity
/// @param rule      one that needs no noise of FRFs
/// Shape   lines of both
/// Units   those of the sensors
/// Errors  throws std::invalid_argument: no reference or target, a sensor that is not there, one
///         that is both, other lines, fewer blocks to learn from than references
/// Limits  a source that no reference is near is handed to those that move with it; a reference
///         that hears several sources is no path. A good score is needed, and is no proof
/// Source  de Klerk & Ossipov, Mech. Syst. Signal Process. 24(7), 1950-1962 (2010)
OperationalPaths operational_paths(const OperatingSpectra& learnt, const OperatingSpectra& held_out,
                                   const std::vector<DegreeOfFreedom>& references,
                                   const std::vector<DegreeOfFreedom>& targets,
                                   const RegularisationRule& rule);

}  // namespace rvbench::analysis
