#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// The deepest lines of a signature that together hold nine tenths of its squared depth, where they
/// were found: slip moves them off their nominal orders.
///
/// @return deepest first; empty where nothing was found
/// Units   orders of the input shaft
/// Errors  none thrown
/// Source  ours
std::vector<double> carrying_lines(const SignatureScore& score, const Signature& signature);

/// Whether each of the lines found lies within `near` of one of the comb.
bool holds_all(const std::vector<double>& comb, const std::vector<double>& found, double near);

}  // namespace rvbench::analysis
