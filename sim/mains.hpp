#pragma once

#include <array>

namespace rvbench::sim {

/// Of mains in Europe and America, and of what it does twice a period: forces, and most pick-up.
inline constexpr std::array mains_frequencies_Hz{50.0, 60.0, 100.0, 120.0};

}  // namespace rvbench::sim
