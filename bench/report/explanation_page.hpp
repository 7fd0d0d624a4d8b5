#pragma once

#include <string>

#include "analysis/explain/explanation.hpp"
#include "bench/explanation_json.hpp"

namespace rvbench::bench {

/// explain.html: one self-contained page. The sentence first, then each effect with its rivals,
/// errors before and after, and what is left over of recordings on one scale.
std::string make_explanation_page(const analysis::Explanation& explanation,
                                  const ExplainFacts& facts, const Comparisons& comparisons);

}  // namespace rvbench::bench
