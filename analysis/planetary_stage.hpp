#pragma once

#include <string>
#include <vector>

#include "analysis/kinematics.hpp"

namespace rvbench::analysis {

/// A sun that drives planets, as an RV reducer's first stage and a planetary stage have it.
/// Orders are turns per turn of the input shaft, without sign.
struct SunStage {
  int planets = 0;
  int sun_teeth = 0;
  double sun = 0;         ///< against the carrier
  double planet = 0;      ///< against the carrier
  double carrier = 0;     ///< in the housing
  bool has_ring = false;  ///< in which the planets roll as well: teeth meet twice a turn
};

/// Signatures of what turns with the input: its shaft, and the sun that sits on it.
/// Source  limits and advice are ours
std::vector<Signature> input_signatures(const SunStage& stage);

/// Signature of a damaged planet tooth.
/// Source  limits and advice are ours
Signature planet_signature(const SunStage& stage);

/// Tooth counts of a planetary stage: the sun drives, the ring stands, the carrier is the output.
struct PlanetaryGeometry {
  int sun_teeth = 0;     ///< zs
  int planet_teeth = 0;  ///< zp
  int ring_teeth = 0;    ///< zr = zs + 2·zp, but for a shift of profiles
  int planets = 0;       ///< N
};

/// Shifted profiles let a ring have a few teeth more or fewer than the standard ones.
inline constexpr int most_shifted_teeth = 4;

/// Characteristic orders and signatures of a planetary stage.
///
///     i = 1 + zr/zs;   sun against carrier (i − 1)/i;   planet against carrier (i − 1)/i·zs/zp;
///     mesh zs·(i − 1)/i = zr/i
///
/// @param planet_bearing  of each planet, on its pin; rolling_elements 0: not known
/// Shape, units  as Kinematics has them; orders of the input shaft
/// Errors  throws std::invalid_argument naming what is not positive, or ring_teeth that leave no
/// room
///         for the planets
/// Source  Willis' equation of planetary gears; limits and advice are ours
Kinematics planetary_stage(const std::string& machine, const PlanetaryGeometry& geometry,
                           const BearingGeometry& planet_bearing);

}  // namespace rvbench::analysis
