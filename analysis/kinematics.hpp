#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "analysis/growth_range.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// One row of the characteristic-order table: events per revolution of the input shaft.
struct CharacteristicOrder {
  std::string name;         ///< "sun-planet mesh"
  double order = 0;         ///< 1080/121
  std::string fraction;     ///< "1080/121"; empty if it is no fraction (bearings)
  std::string component;    ///< the part whose motion it is, as findings name it
  std::string table4_item;  ///< the row of the article's Table 4; empty if it has none
  bool mesh = false;        ///< teeth or lobes passing, not a part going round
};

/// A gear of a mesh, as it turns against what carries the mesh: its teeth pass at the mesh's order.
struct MeshingGear {
  std::string shaft;  ///< "sun against carrier"
  double order = 0;   ///< turns per turn of the input shaft, against the carrier of the mesh
  int teeth = 0;      ///< or lobes, or pins
};

/// Gears that roll on each other. Teeth times order of each gear is the mesh's order.
struct GearMesh {
  std::string name;  ///< that of its characteristic order
  double order = 0;
  std::vector<MeshingGear> gears;
  double path_order = 0;  ///< turns of the contact past the sensors per input turn; 0: it stands
};

/// How a damaged part changes the vibration.
enum class Shows {
  as_turning,  ///< a shaft: forces at its order, and the first sidebands of the meshes it turns
  as_teeth,    ///< a gear or a pin: any multiple of its turn, also where no sound part has a line
  as_printed,  ///< a row of a table of frequencies: a line in the envelopes of the IMFs
  as_blows,    ///< a rolling element: blows that follow the shaft, but are not locked to it
};

/// One way a part can be bad, and the family of envelope lines that it leaves: harmonics
/// first_harmonic..harmonics of `order`, each with its sidebands.
struct Signature {
  std::string component;
  std::string mechanism;
  std::string table4_item;  ///< empty: none
  double order = 0;
  int first_harmonic = 1;  ///< above 1 where a sound machine shows the lower ones as well
  int harmonics = 1;
  std::vector<double> sidebands;  ///< spacings in orders, searched on both sides
  double slip = 0;                ///< relative: how far rolling elements may stray from `order`
  double tolerance = 0;           ///< relative: how far a printed `order` may be off the part's own
  Shows shows = Shows::as_turning;
  int forces = 0;  ///< harmonics of a turning part's own order that are damage, too; 0 where
                   ///< unbalance makes them in a sound machine as well
  bool at_every_speed = false;  ///< its severity is the least of all speeds: where planets cancel
                                ///< the mesh, a resonance makes as much of a sound part at one
  bool strikes = false;   ///< one bad tooth or pin among good ones: blows, not a swing of its mesh
  double turn = 0;        ///< of what is damaged, in its mesh: the spacing of its own lines; orders
  double path_order = 0;  ///< turns of the part past the sensors per input turn; 0: it stands
  double beside_mesh = 1;  ///< share of its damage's power that is beside the mesh's own lines
  GrowthRange load_growth = any_growth;
  double depth_limit = 0;  ///< modulation depth above which the part counts as bad
  /// The same where it shows in noise alone, if that is less: there planets cancel nothing.
  double noise_limit = std::numeric_limits<double>::infinity();
  /// The same of a part that strikes, if that is less: a blow brings its lines in phase.
  double aligned_limit = std::numeric_limits<double>::infinity();
  /// The same of a part that strikes, if that is more: pitch errors of sound teeth scatter phases.
  double scatter_limit = 0;
  /// A record whose noise hides more than a learnt limit is held against what it hides, up to this.
  double limit_in_noise = 0;
  std::string limit_why;
  double sound_median = not_known;   ///< severity of sound units of the same kind, if any were
  double sound_scatter = not_known;  ///< shown, and how far one lies from another
  std::string advice;

  /// One limit, however the part shows. Noise lifts it no further than before.
  void set_limit(double severity) {
    depth_limit = noise_limit = aligned_limit = severity;
    scatter_limit = 0;
  }
};

/// A rolling bearing, by the signatures of its parts.
struct RollingBearing {
  std::string name;
  int rolling_elements = 0;
  double race_order = 0;  ///< turns of the inner race against the outer per input turn
  double cage = 0;        ///< turns of the cage per turn of the inner race against the outer
  std::size_t inner = 0;  ///< indices into Kinematics::signatures
  std::size_t outer = 0;
  std::size_t ball = 0;
  std::size_t cage_wear = 0;
};

/// A machine as the diagnosis sees it.
struct Kinematics {
  std::string machine;
  double period_turns = 1;  ///< input turns after which the gear train repeats; 121 for RV-20E
  std::vector<CharacteristicOrder> orders;
  std::vector<Signature> signatures;
  std::vector<GearMesh> meshes = {};  ///< whose gears are known
  std::vector<RollingBearing> bearings = {};
  double gear_ratio = not_known;              ///< input turns per turn of the output; NaN: has none
  double rated_output_torque_Nm = not_known;  ///< what 100 % load means
};

/// Tooth counts of a two-stage RV reducer: sun drives the planets, each planet turns a crank, the
/// cranks swing the cycloid discs inside the pin shell. Output is the carrier, the shell is fixed.
struct RvGeometry {
  int sun_teeth = 0;     ///< z1
  int planet_teeth = 0;  ///< z2
  int planets = 0;       ///< N, one crank each
  int lobes = 0;         ///< of a cycloid disc, zc
  int pins = 0;          ///< zp = zc + 1
};

/// Rolling bearing; inner race on the shaft, outer race in what it is carried by, but for
/// inner_stands.
struct BearingGeometry {
  int rolling_elements = 0;
  double ball_diameter_mm = 0;
  double pitch_diameter_mm = 0;
  double contact_angle_deg = 0;
  bool inner_stands = false;  ///< under the load, while the outer race turns, as in a planet
};

/// Defect orders of a bearing per revolution of its inner race against its outer race.
/// Source  Harris, Rolling Bearing Analysis (4th ed., 2001): no slip, rigid races
struct BearingOrders {
  double cage = 0;   ///< FTF
  double outer = 0;  ///< BPFO
  double inner = 0;  ///< BPFI
  double ball = 0;   ///< 2·BSF: a ball defect strikes both races in one ball turn
};

/// Orders of one bearing, per turn of the inner race against the outer one; geometry in mm,
/// degrees.
/// @throws std::invalid_argument naming the first value out of range
/// Source  of BearingOrders
BearingOrders bearing_orders(const BearingGeometry& bearing);

/// A bearing with such races: the inverse of bearing_orders(), with a pitch diameter of 1 mm.
/// @param outer, inner  orders of the races per turn of the inner race against the outer one
/// Source  of BearingOrders
BearingGeometry bearing_of_races(double outer, double inner, double contact_angle_deg);

}  // namespace rvbench::analysis
