#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// A later judgement of a run, beside its verdict.json: rejudged-<n>.json of the run folder, a
/// verdict.json of its own with a further key that says when and by what limits.
struct Rejudgement {
  Judgement judgement;
  std::string judged_utc;
  std::string limits_version;  ///< empty: the limits of the plan the run was made with
  std::string limits_sha256;   ///< of the limits file; empty without
};

std::string rejudgement_to_json(const Rejudgement& rejudgement);

/// The inverse; nullopt if the text is no later judgement.
std::optional<Rejudgement> rejudgement_from_json(const std::string& text);

/// Those of a run folder, in the order they were made: "rejudged-1.json", ...
std::vector<std::string> rejudgement_names(const std::filesystem::path& folder);

/// The name that the next one gets.
std::string next_rejudgement_name(const std::filesystem::path& folder);

}  // namespace rvbench::bench
