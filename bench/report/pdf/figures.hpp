#pragma once

#include <string>
#include <vector>

#include "bench/report/pdf/block.hpp"

namespace rvbench::bench::pdf {

/// The plots of the HTML page, side by side in rows; each row is a block.
/// @param figures  inline <svg> elements of SvgPlot
Blocks figure_rows(const std::vector<std::string>& figures, double width_pt, int per_row);

}  // namespace rvbench::bench::pdf
