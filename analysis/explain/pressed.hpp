#pragma once

namespace rvbench::analysis {

/// The root of Cauchy's loss, with its sign: b·√log(1 + (r/b)²). Where physics is missing, values
/// are a hundred standard errors off, and must not bend the numbers that the others tell.
/// @param believable  b: what is farther off counts for little more
/// Units   standard errors. Errors  none thrown
/// Source  Holland & Welsch, Commun. Stat. Theory Methods 6(9), 813-827 (1977): Cauchy's loss
double pressed(double standard_errors, double believable);

/// What pressed() makes this of.
/// Units, errors, source  of pressed(); `believable` finite
double unpressed(double pressed, double believable);

}  // namespace rvbench::analysis
