#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/explain/explanation.hpp"
#include "bench/comparisons.hpp"
#include "bench/located.hpp"

namespace rvbench::bench {

/// What stands around an explanation in explain.json.
struct ExplainFacts {
  std::string plant, software;
  std::string plant_updated;  ///< path, or "" if there is none
  std::vector<RecordError> records;
  Located located;
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, std::string>> hashes;  ///< file, SHA-256
};

/// The document explain.json. Errors are relative: of the outputs' deviation.
std::string explanation_to_json(const analysis::Explanation& explanation,
                                const ExplainFacts& facts);

}  // namespace rvbench::bench
