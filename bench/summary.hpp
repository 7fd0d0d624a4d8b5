#pragma once

#include "analysis/kinematics.hpp"
#include "bench/console.hpp"
#include "bench/run_folder.hpp"

namespace rvbench::bench {

/// The judgement for a reader at a terminal: verdict and reason, findings with their evidence,
/// lines that nothing explains, and what is wrong with the data.
void print_summary(Console& console, const Judgement& judgement,
                   const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
