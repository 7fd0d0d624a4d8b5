#pragma once

#include <optional>
#include <string>

#include "bench/run_folder.hpp"

namespace rvbench::bench {

/// verdict.json, and what --json prints: everything in Judgement. Values that are not known are
/// null.
std::string judgement_to_json(const Judgement& judgement);

/// The inverse; nullopt if the text is no verdict.json.
std::optional<Judgement> judgement_from_json(const std::string& text);

}  // namespace rvbench::bench
