#pragma once

#include <string>

#include "analysis/examples/example.hpp"

namespace rvbench::bench {

/// The plots of an example below each other, as an SVG file that needs no style sheet.
std::string picture_of(const analysis::examples::Example& example);

}  // namespace rvbench::bench
