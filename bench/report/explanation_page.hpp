#pragma once

#include <string>

#include "analysis/explain/explanation.hpp"
#include "bench/explanation_json.hpp"

namespace rvbench::bench {

/// explain.html: one self-contained page. The sentence first, then errors on what was left out,
/// records over what is predicted of them without having been seen, what is left over on one scale
/// of colour, and each effect with its rivals.
std::string make_explanation_page(const analysis::Explanation& explanation,
                                  const ExplainFacts& facts, const Comparisons& comparisons);

}  // namespace rvbench::bench
