#pragma once

#include <string>

#include "bench/console.hpp"
#include "bench/qualification/qualification.hpp"
#include "bench/qualification/station_records.hpp"

namespace rvbench::bench {

/// A line a step: word, the value nearest to its limit (or farthest beyond), reason; then the
/// answer.
std::string self_test_text(const Console& console, const SelfTestRecord& record);

/// As one JSON document, ending with exit_code.
std::string self_test_to_json(const SelfTestRecord& record, const Ending& ending, int exit_code);

/// A line for each thing that is asked, then whether a unit can pass.
std::string qualification_text(const Console& console, const Qualification& qualification);

/// {"qualified", "exit_code", "station", "requirements": [{"requirement", "word", "sentence",
/// "blocks"}]}
std::string qualification_to_json(const Qualification& qualification, const std::string& station);

/// The calibrations on record, a line each.
std::string calibrations_text(const std::vector<CalibrationRecord>& records);
std::string calibrations_to_json(const std::vector<CalibrationRecord>& records);

}  // namespace rvbench::bench
