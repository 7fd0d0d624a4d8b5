#pragma once

#include <string>

#include "bench/population.hpp"

namespace rvbench::bench::report {

/// The earlier units as dots over their values, stacked where they are close; this unit and the
/// limit as marks. An inline <svg>.
std::string strip_plot(const Standing& standing);

}  // namespace rvbench::bench::report
