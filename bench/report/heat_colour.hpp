#pragma once

#include <string>

namespace rvbench::bench::report {

/// White, yellow, red, dark, in even steps of lightness: "#fde79f".
/// @param share  0 to 1; what is beyond is taken as the nearer end
std::string heat_colour(double share);

}  // namespace rvbench::bench::report
