#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "hal/recording_file.hpp"

namespace rvbench::bench {

/// What the page is told of a run's answer, as JSON: word, exit_code, code, reason, findings,
/// run, report. The code is one word for the reason, "none" where it is about the unit. An answer
/// without a verdict is that of a run that was refused: an ERROR.
/// @param answer  what rvbench run --json prints
/// @param run     below `runs`; "" if there is none
std::string verdict_of_answer(const nlohmann::json& answer, const std::string& run,
                              const std::filesystem::path& runs);

/// Speeds, loads, repeats and cells of a plan, for the page's matrix.
/// @param states  of each point: 'o'pen, 'm'easuring, 'd'one, 'f'ailed
nlohmann::json matrix_of(const std::vector<hal::PlannedPoint>& points, const std::string& states);

}  // namespace rvbench::bench
