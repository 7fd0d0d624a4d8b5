#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/own_lines.hpp"

namespace rvbench::analysis {

/// Where a record's gear lines are, for all of its channels that span the same turns.
struct GearPlaces {
  double resolution = 0;           ///< orders per line of the spectrum
  std::vector<PartLines> parts;    ///< one per signature
  std::vector<bool> locked;        ///< one flag per line: gears, shafts and pins may reach it
  std::vector<Eigen::Index> free;  ///< the other lines, ascending
  std::vector<Eigen::Index> free_before;  ///< of each line: how many free ones lie below it
};

/// Shape   as many lines as the spectrum of a channel has that spans so many turns, up to its top
///         order
/// @param is_placed  the speed is as good as measured; else lines beyond what it places are left
///                   out
GearPlaces line_places(double turns, double top_order, double speed_Hz, bool is_placed,
                       const Kinematics& kinematics);

/// The same in the squared envelope of what is left without the gears' lines: where a part makes
/// noise that comes and goes with its turn. No two carriers beat there.
///
/// @param lines  of that envelope
GearPlaces envelope_places(const Kinematics& kinematics, double resolution, std::size_t lines);

}  // namespace rvbench::analysis
