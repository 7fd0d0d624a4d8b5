#pragma once

#include "analysis/explain/explanation.hpp"
#include "bench/console.hpp"
#include "bench/explanation_json.hpp"

namespace rvbench::bench {

/// The explanation on standard output: the answer, its effects, the error of each record, and what
/// one repeat as the model of another came to.
void print_explanation(Console& console, const analysis::Explanation& explanation,
                       const ExplainFacts& facts);

}  // namespace rvbench::bench
