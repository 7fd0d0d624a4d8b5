#pragma once

namespace rvbench::analysis {

/// Exponents of the load with which the vibration that a mechanism modulates may grow.
struct GrowthRange {
  double least = 0;
  double most = 0;
};

/// An error of shape or place shakes alike whatever the load, 0, until what it moves carries the
/// load, 1. To either side a quarter for what else in the channel grows.
/// Source  Smith, Gear Noise and Vibration (2nd ed., 2003): transmission error as the cause, the
///         force that holds the teeth together as the bound
inline constexpr GrowthRange grows_as_shape{-0.25, 1.25};

/// Damage is struck by what is pressed over it: by a stiff contact as the load, 1; one that is
/// pressed together without it, by preload or friction, less. A blow grows beyond that where the
/// load also brings the next tooth or roller later into contact.
/// Source  Johnson, Contact Mechanics (1985), ch. 4: a Hertzian approach goes as load^(2/3)
inline constexpr GrowthRange grows_as_blows{0.25, 1.5};

/// What a flank lacks is an error of shape until the load presses it to the ground, and a blow
/// then; and where it is not known whether the load goes through the part at all.
inline constexpr GrowthRange any_growth{-0.25, 1.5};

}  // namespace rvbench::analysis
