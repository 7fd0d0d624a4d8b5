#pragma once

#include <nlohmann/json.hpp>

#include "analysis/diagnosis.hpp"

namespace rvbench::bench {

/// {"findings", "quality", "resolvable", "below_limit", "not_shown", "unexplained"}
/// Units  in the names of the keys; null is what is not known. Errors  none thrown
nlohmann::ordered_json json_of(const analysis::Diagnosis& diagnosis);
nlohmann::ordered_json json_of(const analysis::Examination& examination);

/// The inverses. Keys that say more of a finding, score or record than what and where it is may be
/// absent: not known.
/// @throws nlohmann::json::exception where another key is missing or one is of another type
analysis::Diagnosis diagnosis_from_json(const nlohmann::ordered_json& json);
analysis::Examination examination_from_json(const nlohmann::ordered_json& json);

/// null is what JSON has for NaN.
double number_or_nan(const nlohmann::ordered_json& json);

}  // namespace rvbench::bench
