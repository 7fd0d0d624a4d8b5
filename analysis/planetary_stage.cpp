#include "analysis/planetary_stage.hpp"

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "analysis/bearing_signatures.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

constexpr double limit_of_one_mesh = 0.15;
// A worn profile is alike on all teeth to the larger part, which strengthens the mesh's own lines.
// Source  ours
constexpr double beside_mesh_of_profile = 0.4;

// Equal planets cancel what is alike in their meshes, unless it comes in phase. Beside a mesh that
// is cancelled a sound swing seems deeper, and most where the teeth put its own line in phase.
double shaft_limit(const SunStage& stage) {
  if (stage.planets == 1) return limit_of_one_mesh;
  const int off = stage.sun_teeth % stage.planets;
  const bool neighbours_add = off == 1 || off == stage.planets - 1;
  if (neighbours_add) return 0.25;
  return off == 0 ? 0.1 : 0.12;  // torque that swings by 6 % reads as 0.085
}

struct Limit {
  double severity = 0;
  const char* why = "";
};

// Beside a ring the record has about ten turns of the carrier, and few lines that are a gear's own.
Limit sun_limit(const SunStage& stage) {
  if (stage.has_ring) return {0.2, "assumed: pitch and runout of sound teeth swing by a fifth"};
  return {stage.planets > 2 ? 0.085 : 0.13,
          "assumed: teeth of one quality class share the load within an eighth"};
}

Limit planet_limit(const SunStage& stage) {
  if (stage.has_ring) {
    return {0.1,
            "assumed: a planet that rolls in a ring has few lines of its own, and ten turns "
            "of the carrier show no less of it"};
  }
  return {stage.planets > 2 ? 0.06 : 0.1,
          "assumed: pitch errors of sound teeth put a tenth of the mesh on such lines, and less "
          "where more than two planets share it"};
}

// Pitch errors of two planets do not cancel as those of three, and a ring's meet them once more.
double limit_of_scattered_planet(const SunStage& stage) {
  if (stage.has_ring) return 0.25;
  return stage.planets > 2 ? 0.1 : 0.2;
}

void check(const PlanetaryGeometry& g) {
  require_positive(g.sun_teeth, "planetary_stage", "sun_teeth");
  require_positive(g.planet_teeth, "planetary_stage", "planet_teeth");
  require_positive(g.ring_teeth, "planetary_stage", "ring_teeth");
  require_positive(g.planets, "planetary_stage", "planets");
  const int fitting = g.sun_teeth + 2 * g.planet_teeth;
  if (std::abs(g.ring_teeth - fitting) > most_shifted_teeth) {
    throw std::invalid_argument("planetary_stage: ring_teeth are " + std::to_string(g.ring_teeth) +
                                ", must be about sun_teeth + 2 planet_teeth, " +
                                std::to_string(fitting));
  }
}

Signature ring_signature(const SunStage& stage) {
  const double passing = stage.planets * stage.carrier;
  return {.component = "ring_gear",
          .mechanism = "tooth_damage",
          .table4_item = "",
          .order = passing,
          .harmonics = 24,
          .sidebands = {},
          .shows = Shows::as_teeth,
          .strikes = true,
          .turn = passing,
          .depth_limit = 0.15,
          .aligned_limit = 0.05,
          .limit_why = "assumed: one tooth among many may not stand out by more than its share",
          .advice = "look at the ring's flanks; replace the ring"};
}

}  // namespace

std::vector<Signature> input_signatures(const SunStage& stage) {
  return {
      {.component = "input_shaft",
       .mechanism = "misalignment",
       .table4_item = "",
       .order = 1,
       .harmonics = 2,
       .sidebands = {},
       .shows = Shows::as_turning,
       .forces = 2,
       .at_every_speed = stage.planets > 2,
       .turn = stage.sun,
       .path_order = stage.carrier,
       .load_growth = grows_as_shape,
       .depth_limit = shaft_limit(stage),
       .noise_limit = limit_of_one_mesh,
       .limit_why = "assumed: a shaft within tolerance leans on its bearing by less than a sixth "
                    "of its preload",
       .advice = "stiffen or shorten the input shaft, or support its free end with a bearing; "
                 "check the run-out at the sun and the alignment of the coupling"},
      {.component = "sun_gear",
       .mechanism = "profile_error",
       .table4_item = "",
       .order = stage.sun,
       .harmonics = 8,
       .sidebands = {stage.carrier, 2 * stage.carrier},
       .shows = Shows::as_teeth,
       .at_every_speed = stage.planets > 2,
       .turn = stage.sun,
       .path_order = stage.carrier,
       .beside_mesh = beside_mesh_of_profile,
       .load_growth = grows_as_shape,
       .depth_limit = sun_limit(stage).severity,
       .limit_why = sun_limit(stage).why,
       .advice = "measure the sun gear's tooth profile and pitch; replace the input gear"},
  };
}

Signature planet_signature(const SunStage& stage) {
  return {.component = "planet_gear",
          .mechanism = "tooth_damage",
          .table4_item = "",
          .order = stage.planet,
          .harmonics = 24,
          .sidebands = {stage.carrier},
          .shows = Shows::as_teeth,
          .strikes = true,
          .turn = stage.planet,
          .path_order = stage.carrier,
          .load_growth = any_growth,
          .depth_limit = planet_limit(stage).severity,
          .scatter_limit = limit_of_scattered_planet(stage),
          .limit_why = planet_limit(stage).why,
          .advice = "open the reducer and look at the planets' flanks; replace the planet pair"};
}

Kinematics planetary_stage(const std::string& machine, const PlanetaryGeometry& geometry,
                           const BearingGeometry& planet_bearing) {
  check(geometry);
  const double i = 1 + static_cast<double>(geometry.ring_teeth) / geometry.sun_teeth;
  const double sun = (i - 1) / i;
  const SunStage stage{.planets = geometry.planets,
                       .sun_teeth = geometry.sun_teeth,
                       .sun = sun,
                       .planet = sun * geometry.sun_teeth / geometry.planet_teeth,
                       .carrier = 1 / i,
                       .has_ring = true};
  const double mesh = sun * geometry.sun_teeth;
  Kinematics k;
  k.machine = machine;
  k.period_turns = i;  // all its lines are sums of multiples of 1/i and of the gears' own turns
  k.gear_ratio = i;
  k.orders = {{"input shaft", 1, "", "input_shaft", ""},
              {"sun against carrier", stage.sun, "", "sun_gear", ""},
              {"planet against carrier", stage.planet, "", "planet_gear", ""},
              {"planet mesh", mesh, "", "sun_gear", "", true},
              {"carrier", stage.carrier, "", "carrier", ""},
              {"planet pass", geometry.planets * stage.carrier, "", "ring_gear", ""}};
  k.meshes = {{"planet mesh",
               mesh,
               {{"sun against carrier", stage.sun, geometry.sun_teeth},
                {"planet against carrier", stage.planet, geometry.planet_teeth},
                {"ring against carrier", stage.carrier, geometry.ring_teeth}},
               stage.carrier}};
  k.signatures = input_signatures(stage);
  k.signatures.push_back(planet_signature(stage));
  k.signatures.push_back(ring_signature(stage));
  if (planet_bearing.rolling_elements > 0) {
    k.bearings.push_back(
        rolling_bearing("planet bearing", planet_bearing, stage.planet, k.signatures.size()));
    for (Signature& s : bearing_signatures(planet_bearing, stage.planet, 0.02)) {
      constexpr double just_seen = 0.2;
      if (s.depth_limit < just_seen) {
        s.depth_limit = just_seen;
        s.limit_why = "assumed: ten turns of the carrier hold few blows, and show no less of them";
      }
      k.orders.push_back({"planet " + s.component, s.order, "", s.component, ""});
      k.signatures.push_back(std::move(s));
    }
  }
  return k;
}

}  // namespace rvbench::analysis
