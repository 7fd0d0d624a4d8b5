#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/explain/pushes.hpp"
#include "analysis/explain/residual_cells.hpp"
#include "analysis/explain/torque_balance.hpp"
#include "bench/pushed_features.hpp"

namespace rvbench::bench {

/// Where in the machine the forces act that a plant lacks.
struct MissingForce {
  std::vector<ForceSite> sites;
  analysis::Pushes pushes;
  std::string transducer;
  std::vector<std::string> left, right;  ///< bodies on either side of the transducer
  std::vector<analysis::SideBalance> balances;
};

/// @param located  what differs by more than chance: nothing else is explained
MissingForce find_missing_force(const PushedFeatures& features,
                                const std::vector<analysis::ResidualCluster>& located);

/// "order 12.893, order 25.785: a force in stage_1 (or in stage_2) explains 97 ± 1 %; 0.02 N·m on
/// planet_1": share and size are of the first line.
std::string source_text(const MissingForce& missing, const analysis::PushSource& source);

/// "means: right of input_torque (input_shaft, ...), drag differs by +0.12 ± 0.01 N·m ..."
std::string balance_text(const MissingForce& missing, const analysis::SideBalance& balance);

/// What is to be told of it, one line each: sources, farthest off first, then means.
/// @param most_sources  at most so many of these
std::vector<std::string> told(const MissingForce& missing, std::size_t most_sources);

}  // namespace rvbench::bench
