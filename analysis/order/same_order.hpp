#pragma once

namespace rvbench::analysis {

/// Characteristic orders nearer than this are one line: the same quotient of tooth numbers, but for
/// rounding.
inline constexpr double same_order = 1e-6;

}  // namespace rvbench::analysis
