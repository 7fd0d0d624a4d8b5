#pragma once

/// The RV-20E as built: what its maker and its teeth decide. Teeth and ratio are the article's;
/// where no source is named, a value is assumed.
namespace rvbench::sim::rv_20e {

inline constexpr int sun_teeth = 9;
inline constexpr int planet_teeth = 27;
inline constexpr int pins = 40;
inline constexpr double gear_ratio = 121;  ///< 1 + planet_teeth/sun_teeth·pins

// Base radii m·z·cos(20°)/2; a module of 1.25 mm is assumed.
inline constexpr double sun_base_radius_m = 5.3e-3;
inline constexpr double planet_base_radius_m = 15.9e-3;
inline constexpr double pin_circle_radius_m = 52e-3;  ///< assumed: fits a housing of 145 mm

/// Maker's catalogue: 49 N·m per arc minute at the output.
inline constexpr double torsional_stiffness_Nm_rad = 168e3;

}  // namespace rvbench::sim::rv_20e
