#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Load brake that holds at standstill: dry friction of the torque that it is told.
///
///     F = |u|·tanh(v/v_ε)
///
/// Solved for stick and slip, as all dry friction is: v_ε may be so low that nothing is seen to
/// creep.
/// Leaves out: more torque at standstill than in slip, the time that it takes to grip.
/// Source: Armstrong-Hélouvry et al., Automatica 30(7), 1083-1138 (1994), §2
TermType holding_brake();

}  // namespace rvbench::sim
