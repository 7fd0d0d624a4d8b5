#pragma once

#include <string>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// Any machine of parallel shafts, tooth meshes and rolling bearings. The first shaft is the input.
struct GearTrain {
  struct Shaft {
    std::string name;
    std::string component;  ///< what a finding on it is called
  };
  /// Two gears in mesh; turns the driven shaft driver_teeth/driven_teeth times the driver's speed.
  struct Mesh {
    std::string name;
    int driver = 0;  ///< index into shafts
    int driver_teeth = 0;
    int driven = -1;       ///< index into shafts; −1: not known, the mesh line alone is
    int driven_teeth = 0;  ///< 0 if not known
    std::string driver_component;
    std::string driven_component;
  };
  struct Bearing {
    std::string name;
    int shaft = 0;
    BearingGeometry geometry;
    double slip = 0.02;  ///< relative: how far its orders may stray from the geometry's
  };

  std::string machine;
  std::vector<Shaft> shafts;
  std::vector<Mesh> meshes;
  std::vector<Bearing> bearings;
};

/// Orders of every shaft: turns per input turn; 0 where no mesh leads there.
/// @throws std::invalid_argument if there is no shaft, or naming a count of teeth that is not
///         positive or a shaft that does not exist
/// Shape, units  one order per shaft: turns per turn of the first, without sign
/// Source  Randall, Vibration-based Condition Monitoring (2011), ch. 2
std::vector<double> shaft_orders(const GearTrain& train);

/// Characteristic orders and signatures of such a machine. Races, rolling elements and cage of one
/// bearing are the components "bearing_inner" and so on; of several, each under its bearing's name:
/// "drive end bearing_inner".
/// @throws std::invalid_argument as shaft_orders() does, or naming a shaft that no mesh leads to
/// Shape, units  every shaft, mesh and bearing; orders of the first shaft
/// Source  Randall, Vibration-based Condition Monitoring (2011), ch. 2; limits and advice are ours
Kinematics gear_train(const GearTrain& train);

}  // namespace rvbench::analysis
