#pragma once

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Elastic element that slips: stiff after each reversal, yielding further on.
///
///     F = k·z,   dz/dt = v·(1 − |z|/y)  while v and z have one sign,  dz/dt = v otherwise
///
/// z is its elastic way and stays below y; the force ends at k·y. Rate-independent.
/// Leaves out: hardening, several elements in parallel.
/// Source: Ismail, Ikhouane & Rodellar, Arch. Comput. Methods Eng. 16, 161-188 (2009), β = γ, n = 1
TermType stiffness_hysteresis();

}  // namespace rvbench::sim
