#pragma once

#include <string>

#include "bench/station/chart_text.hpp"

namespace rvbench::bench {

/// The document chart.html: the word, individuals, moving ranges and weighted mean with their
/// limits, every signal by its rule, indices with intervals, and the method.
std::string make_chart_page(const ChartAnswer& answer);

}  // namespace rvbench::bench
