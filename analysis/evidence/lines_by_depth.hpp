#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Indices of a score's lines, deepest first; of equals in their order.
/// Errors  none thrown. Source  ours: what is told of a signature, and what carries it
std::vector<std::size_t> lines_by_depth(const SignatureScore& score);

}  // namespace rvbench::analysis
