#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Lines of a spectrum that lie closer than this share of its resolution are the same.
inline constexpr double same_carrying_line = 0.75;

/// The signature that a score is of.
/// Errors  throws std::invalid_argument: the kinematics has no such one
const Signature& signature_of(const SignatureScore& score, const Kinematics& kinematics);

/// Every line that a signature may have, sidebands that other parts claim among them.
///
/// @param first    harmonic; 0 begins with the spacings of the sidebands
/// @param stretch  of its harmonics, as harmonic_lines() has it
/// Units   orders of the input shaft
/// Errors  none thrown
/// Source  harmonic_lines()
std::vector<double> comb_lines(const Signature& signature, int first, double stretch);

/// The deepest lines of a signature that together hold nine tenths of its squared depth, where they
/// were found: slip moves them off their nominal orders.
///
/// @return deepest first; empty where nothing was found
/// Units   orders of the input shaft
/// Errors  none thrown
/// Source  ours
std::vector<double> carrying_lines(const SignatureScore& score);

/// Whether each of the lines found lies within `near` of one of the comb.
/// Units   orders of the input shaft. Errors  none thrown. Source  definition
bool holds_all(const std::vector<double>& comb, const std::vector<double>& found, double near);

}  // namespace rvbench::analysis
