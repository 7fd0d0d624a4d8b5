#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// verdict.json, and what --json prints: everything in Judgement. Values that are not known are
/// null.
std::string judgement_to_json(const Judgement& judgement);

/// What --json prints of a command that came to no judgement: the first keys of verdict.json.
/// "verdict" is INVALID where data was refused, else null.
std::string refusal_to_json(int exit_code, const std::vector<std::string>& complaints);

/// The inverse of judgement_to_json; nullopt if the text is no verdict.json.
std::optional<Judgement> judgement_from_json(const std::string& text);

/// Of a run folder's verdict.json; nullopt too if it is not the one of the run's end, by
/// SHA256SUMS.
std::optional<Judgement> judgement_in(const std::filesystem::path& run);

}  // namespace rvbench::bench
