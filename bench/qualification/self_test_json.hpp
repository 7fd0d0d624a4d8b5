#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "bench/qualification/self_test_step.hpp"

namespace rvbench::bench {

/// Steps with word, reason and readings.
nlohmann::ordered_json json_of(const std::vector<SelfTestResult>& steps);

/// The inverse. @throws nlohmann::json::exception if it is none
std::vector<SelfTestResult> self_test_from_json(const nlohmann::ordered_json& json);

}  // namespace rvbench::bench
