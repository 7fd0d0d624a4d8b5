#pragma once

#include "bench/report/pdf/block.hpp"
#include "bench/report/pdf/typesetter.hpp"
#include "bench/report/report.hpp"

namespace rvbench::bench::pdf {

/// The first page: the verdict, whose it is, findings with advice, the matrix, limits, the unit
/// among earlier ones, and hashes to sign. Never more than a page: findings, limits and plots are
/// left out from the least on until it fits, and it says how many are in the appendix.
Blocks verdict_page(const Typesetter& typesetter, const ReportInput& input);

}  // namespace rvbench::bench::pdf
