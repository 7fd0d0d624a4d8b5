#pragma once

#include <cstddef>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// The places of a line that a path which turns spreads: a path has a mean, a first and a second
/// harmonic.
/// Units  orders of the input shaft
std::vector<double> spread(double order, double path_order);

/// True if an order lies within `near` of a multiple of `turn`. The path may have spread it.
/// Units  orders of the input shaft
bool comb_holds(double turn, double path_order, double order, double near);

/// Of a mesh, each spread by its path.
/// Units  orders of the input shaft
std::vector<double> harmonics_of(const GearMesh& mesh, double top_order);

/// Every line of a sound machine: meshes with their paths, the first sidebands of their gears, and
/// shafts at once and twice per turn.
///
/// Shape   ascending, up to top_order
/// Units   orders of the input shaft
/// Source  McFadden, J. Vib. Acoust. 108(2), 165-170 (1986): gears of a sound mesh modulate it once
///         per turn; McFadden & Smith, Proc. IMechE 199, 65-70 (1985): a contact that passes the
///         sensors spreads its lines by multiples of its own order
std::vector<double> sound_lines(const Kinematics& kinematics, double top_order);

/// How far an order is from the nearest that gears, shafts and pins may reach, sound or damaged.
/// Units  orders of the input shaft
double distance_from_gears(const Kinematics& kinematics, double order);

/// Lines of a spectrum that gears, shafts and pins may reach, sound or damaged: those within
/// `reach` of a multiple of a turn, or of one over the gear train's period.
///
/// Shape   one flag per line of the spectrum
/// Units   resolution in orders of the input shaft; reach in lines
std::vector<bool> locked_lines(const Kinematics& kinematics, double resolution, std::size_t lines,
                               double reach);

}  // namespace rvbench::analysis
