#pragma once

#include <vector>

#include "analysis/explain/screen.hpp"
#include "analysis/explain/trial.hpp"

namespace rvbench::analysis {

/// Two candidates that may be missing together, though neither shows alone.
struct Pair {
  std::size_t first, second;  ///< indices into the library
  double gain;                ///< log density that they promise
};

/// The four of a screening that promise most, most first: none of them by chance.
/// Units   gains in nats. Errors  none thrown. Source  pair_p_value(); that four are tried is ours
std::vector<Pair> promising_pairs(const Tryout& on, const std::vector<Screened>& screened);

struct PairTrial {
  Trial first, second;  ///< the second on top of the first
};

/// Tries both on top of what stands. Left-out conditions are forecast.
/// @param before  with forecasts, likewise
/// @return the second is refused where the two are not clearly better than neither
/// Units, errors, source  of try_effect()
PairTrial try_pair(const Tryout& on, const Standing& before, const Pair& pair);

}  // namespace rvbench::analysis
