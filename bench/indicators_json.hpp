#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/indicators/indicator.hpp"

namespace rvbench::bench {

/// Indicators of a channel, one entry per measure: {"name": "band_rms", "unit": "m/s²", "values":
/// {"sun-planet mesh": 0.2, ...}}, and "errors" likewise, of those that have one: half of the 95 %
/// interval. What is of the whole signal is at "whole".
nlohmann::ordered_json indicators_to_json(const std::vector<analysis::Indicator>& indicators);

/// Those of a channel or point; none where it states none.
/// @throws nlohmann::json::exception if they are something else
std::vector<analysis::Indicator> indicators_from_json(const nlohmann::ordered_json& judged);

}  // namespace rvbench::bench
