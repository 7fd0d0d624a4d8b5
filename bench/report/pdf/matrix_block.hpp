#pragma once

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/typesetter.hpp"
#include "bench/report/report.hpp"

namespace rvbench::bench::pdf {

/// The matrix of speed and load, a box per record, as on the HTML page but no higher than 100 pt
/// whatever the plan; boxes too small for their numbers have none. Empty if no point is planned by
/// speed and load.
Blocks matrix_blocks(const Typesetter& typesetter, const ReportInput& input, double width_pt);

}  // namespace rvbench::bench::pdf
