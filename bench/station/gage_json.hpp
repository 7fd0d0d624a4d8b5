#pragma once

#include <string>

#include "bench/station/gage_text.hpp"

namespace rvbench::bench {

/// The document gage.json: verdict, shares, components with their intervals, analysis of variance.
/// Shares are 0 to 1, deviations in the unit of the readings.
std::string gage_to_json(const GageAnswer& answer);

}  // namespace rvbench::bench
