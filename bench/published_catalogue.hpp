#pragma once

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"

namespace rvbench::bench {

/// Whether the machine is the one of the article's Table 4: what the table names turns and meshes
/// as in the built-in rv20e.
bool is_of_table4(const analysis::Kinematics& derived);

/// The table rounds, and mixes speeds: it does not hold every line of a fault. A judgement by it is
/// INVALID where one by the derived orders finds a part that it does not name, or cannot tell: what
/// it names instead may show that part's lines. A quality note says so.
void hold_against_derived(Judgement& published, const Judgement& derived);

}  // namespace rvbench::bench
