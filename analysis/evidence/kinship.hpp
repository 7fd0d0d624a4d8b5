#pragma once

#include <cstddef>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// Whether two parts turn together, in whatever meshes.
bool turn_alike(const Signature& a, const Signature& b);

/// Whether no line of any record parts two signatures: gears on one shaft, of other meshes, rows of
/// a table that print the same frequency, and sun and ring of a stage whose planets pass a whole
/// number of times per turn of the sun.
bool have_the_same_lines(const Signature& a, const Signature& b);

/// Whether the planets of a stage hide which of the two is bad: sun and ring, as above. What one of
/// them does not show is no evidence then, as equal planets cancel it.
bool planets_hide(const Signature& a, const Signature& b);

/// Whether what one part shows may come of another, graver one: bad teeth load their shaft unevenly
/// as they go round, and what comes loose from one part of a bearing marks the others.
///
/// @param lesser, graver  indices into kinematics.signatures
bool may_follow_from(std::size_t lesser, std::size_t graver, const Kinematics& kinematics);

/// Whether a gear of the mesh makes so many turns per input turn, against what carries the mesh.
bool is_gear_of(const GearMesh& mesh, double turn);

/// Whether both are gears of one mesh, or shafts of such, and none sits on the other's shaft.
bool share_a_mesh(std::size_t one, std::size_t other, const Kinematics& kinematics);

}  // namespace rvbench::analysis
