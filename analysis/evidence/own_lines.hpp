#pragma once

#include <cstddef>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// A line of the order spectrum that one part makes when it is damaged.
struct OwnLine {
  double order = 0;
  /// Lines of other parts' combs that also hold this one: it speaks for the part as far as it
  /// exceeds them.
  std::vector<double> rivals = {};
  /// Harmonics of meshes, the loudest lines there are, that a speed that wanders spreads this far.
  std::vector<double> carriers = {};
  int harmonic = 0;    ///< of the part's turn, whose path spreads it; 0: it is alone
  double carrier = 0;  ///< order of the mesh line that it stands beside, where planets cancel none
                       ///< of the mesh's lines; 0: it is alone
  bool is_force = false;  ///< of a shaft at its own order, not beside a mesh
};

/// Where one signature is looked for in the order spectrum of the signal itself.
struct PartLines {
  std::vector<OwnLine> own;
  double share = 1;          ///< of what damage does to the part's lines, by their number
  std::vector<double> mesh;  ///< harmonics of its meshes with their paths: what severity refers to
  std::vector<int> turn_lines;  ///< multiples of its turn that blow_phases() reads
  double contact_order = 0;     ///< order at which its teeth meet, of the slowest of its meshes
};

/// The own lines of each signature.
///
/// Damage of a tooth repeats with its gear's turn, so its lines lie on any multiple of that turn.
/// Those that a sound machine has as well, or another part's comb holds, say nothing. A gear whose
/// every line belongs to another's comb, as the sun's 120/121 belong to the planet's 40/121, is
/// judged by what it has over the lines beside that are the other's alone. A shaft makes the first
/// sidebands, which are every gear's: it is judged by what it has over the further ones.
///
/// @param apart   orders that two lines must lie apart to be told apart
/// @param wander  orders: how far a speed that wanders spreads a line, as it passes resonances
/// Shape   one per signature, in their order; empty for what rolls
/// Units   orders of the input shaft
/// Source  of sound_lines(); the choice is ours
std::vector<PartLines> own_lines(const Kinematics& kinematics, double apart, double wander,
                                 double top_order);

}  // namespace rvbench::analysis
