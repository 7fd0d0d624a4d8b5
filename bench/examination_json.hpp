#pragma once

#include <nlohmann/json.hpp>

#include "analysis/diagnosis.hpp"

namespace rvbench::bench {

/// {"findings", "quality", "resolvable", "below_limit", "unexplained"}
nlohmann::ordered_json json_of(const analysis::Diagnosis& diagnosis);
nlohmann::ordered_json json_of(const analysis::Examination& examination);

// The inverses; they throw nlohmann::json::exception where a key is missing or of another type.
analysis::Diagnosis diagnosis_from_json(const nlohmann::ordered_json& json);
analysis::Examination examination_from_json(const nlohmann::ordered_json& json);

/// null is what JSON has for NaN.
double number_or_nan(const nlohmann::ordered_json& json);

}  // namespace rvbench::bench
