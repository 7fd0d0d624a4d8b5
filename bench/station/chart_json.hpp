#pragma once

#include <string>

#include "bench/station/chart_text.hpp"

namespace rvbench::bench {

/// The document chart.json: verdict, baseline, every signal with its rule, the newest value, and
/// indices with intervals; values that are not known are null.
std::string chart_to_json(const ChartAnswer& answer);

}  // namespace rvbench::bench
