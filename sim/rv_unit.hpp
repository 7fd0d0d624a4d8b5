#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/housing_path.hpp"

namespace rvbench::sim {

/// Deviations of one reducer from the drawing, and of the bench around it. Lengths in µm are what
/// a metrologist would write down; a fault is one of them out of tolerance, never a label.
struct RvDeviations {
  double shaft_eccentricity_um = 0;  ///< run-out of the cantilevered input shaft at the sun
  double shaft_misalignment_um = 0;  ///< angular misalignment of coupling and shaft, at the sun
  double sun_tooth_error_um = 0;     ///< tooth-to-tooth profile error, goes round with the sun
  double mesh_profile_um = 0;        ///< common profile error: harmonics of the tooth mesh
  double planet_eccentricity_um = 0;
  double planet_bad_tooth_um = 0;  ///< height lost on one tooth of one planet
  double crank_error_um = 0;       ///< eccentric error of the cranks
  double pin_spread_um = 0;        ///< of all pins: ripple of the lobe pass
  double bad_pin_um = 0;           ///< one pin proud of the others
  double bearing_spall_um = 0;     ///< on the inner race of one crank's bearing
};

inline constexpr double um = 1e-6;  ///< m

/// Where the phase of each deviation stands in RvUnit::phases_rad.
namespace phase_of {
enum Index : std::size_t {
  shaft_eccentricity,
  shaft_misalignment,
  sun_tooth_error,
  mesh_profile,
  planet_eccentricity,
  planet_bad_tooth,
  crank_error,
  pin_spread,
  bad_pin,
  bearing_spall
};
}  // namespace phase_of

/// One unit on one bench: what a seed draws.
struct RvUnit {
  RvDeviations deviations;
  std::vector<double> phases_rad;  ///< of the deviations, see phase_of
  int marked_planet = 0;           ///< the one with the bad tooth or the spalled bearing
  double bearing_slip = 0;         ///< of the cage, relative
  double motor_slip_factor = 1;
  double friction_factor = 1;
  double noise_level_factor = 1;  ///< of contact and sensor noise
  double noise_colour = 0;        ///< pole of the contact noise's one-pole filter, (−1, 1)
  double disc_mismatch = 0;       ///< how unequally the two discs share the load, relative
  std::vector<double> sensor_gains;
  std::vector<HousingMode> modes;
  std::uint64_t noise_seed = 0;
};

/// Force ports of the housing, three directions (+X up, +Z left, +Y axial) of each place where
/// the train leans on it.
namespace ports {
inline constexpr int input_bearing = 0;  ///< X, Z, Y
inline constexpr int sun_mesh = 3;       ///< X, Z
inline constexpr int pin_shell = 5;      ///< X, Z
inline constexpr int crank_bearing = 7;  ///< X, Z
inline constexpr int count = 9;
}  // namespace ports

/// Draws a unit. The seed draws everything but the kind of fault: severity by a factor of two each
/// way, phases, housing modes ±10 %, gains, slip, noise level and colour.
/// @param severity  of the fault, in those of the preset, instead of a drawn one: everything else
///                  stays as it is. The least that is left is what tolerances allow
/// @throws std::invalid_argument if there is no such preset: names the ones there are
RvUnit draw_unit(const std::string& preset, std::uint64_t seed,
                 std::optional<double> severity = std::nullopt);

}  // namespace rvbench::sim
