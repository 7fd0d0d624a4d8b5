#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// A mesh and how far apart its sidebands are looked for.
struct SidebandPlace {
  std::string name;  ///< "sun-planet mesh at input shaft"
  CharacteristicOrder mesh;
  double spacing = 0;
};

/// A gear of a mesh, to be averaged over its turns.
struct GearPlace {
  std::string name;  ///< "sun-planet mesh, sun against carrier"
  std::string mesh;
  MeshingGear gear;
};

/// How far a rolling element may stray from an order, relative to it; 0 of what is locked to the
/// input shaft. Units, errors, source  of locked_orders()
double slip_of(const CharacteristicOrder& order, const Kinematics& kinematics);

/// Orders that are locked to the input shaft: all but those of rolling elements, which slip.
/// Units  of the kinematics. Errors  none thrown. Source  ours
std::vector<CharacteristicOrder> locked_orders(const Kinematics& kinematics);

/// Every mesh with every locked order that is none, each spacing once, by its first name.
/// Units, errors, source  of locked_orders()
std::vector<SidebandPlace> sideband_places(const Kinematics& kinematics);

/// Every gear of every mesh that is known with its teeth.
/// Units, errors, source  of locked_orders()
std::vector<GearPlace> gear_places(const Kinematics& kinematics);

/// What a limit on a measure may be narrowed to on this machine: names of bands, of orders, of
/// meshes. None for a measure of a whole signal.
/// Errors, source  of locked_orders()
std::vector<std::string> places_of(std::string_view measure, const Kinematics& kinematics);

}  // namespace rvbench::analysis
