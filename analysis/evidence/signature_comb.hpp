#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/signature_lines.hpp"

namespace rvbench::analysis {

/// Where one signature's lines are looked for in a spectrum over orders.
///
/// Harmonics are stretched together within the signature's slip or tolerance, so densely that the
/// highest moves by half a line from try to try; sidebands keep their spacing, as harmonic_lines()
/// has it.
struct SignatureComb {
  std::vector<SignatureLine> lines;
  double order = 0;                ///< the signature's own
  bool rolls = false;              ///< looked for where the gear train has no line
  Eigen::VectorXd stretches = {};  ///< ascending, 1 among them
  Eigen::Index nominal = 0;        ///< index of stretch 1
  Eigen::MatrixXi bins = {};       ///< line of the spectrum: lines × stretches
  double resolution = 0;           ///< orders per line of the spectrum

  /// Order of a line where the harmonics are stretched so.
  double order_of(const SignatureLine& line, double stretch) const;

  /// Line of the spectrum that is nearest to an order.
  Eigen::Index bin_of(double order) const;
};

/// The combs of all signatures of a machine.
/// Shape   one per signature, in their order
/// Units   orders of the input shaft
/// Errors  throws std::invalid_argument: resolution not above 0
/// Source  signature_lines()
std::vector<SignatureComb> signature_combs(const Kinematics& kinematics, double resolution);

/// Shifts, in lines of the spectrum, that take a comb to where no part of the machine has lines: of
/// the gear train's combs to between its lines; of what rolls anywhere beyond its own search.
///
/// @param locked_every  lines from one line of the gear train to the next; 0: there are none
/// @return fewest_decoys to `decoys` shifts, half of them down
/// Errors  none thrown. Source  ours: as decoy databases give search engines of mass spectra their
///         rate of false alarms, Elias & Gygi, Nat. Methods 4(3), 207-214 (2007)
std::vector<Eigen::Index> decoy_shifts(const SignatureComb& comb, Eigen::Index locked_every);

inline constexpr int decoys = 96;         ///< where they lie within an order of the comb, else
inline constexpr int fewest_decoys = 48;  ///< down to so many: the floor's own error is not the
                                          ///< same farther away

}  // namespace rvbench::analysis
