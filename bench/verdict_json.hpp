#pragma once

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

}  // namespace rvbench::bench
