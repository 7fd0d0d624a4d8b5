#pragma once

#include <vector>

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Every place of a plant where an effect of this type may act, by its gate: each body against the
/// housing, each pair of bodies that a term joins, with each input, term or body it may refer to.
/// An effect that only replaces terms of one type is tried in the place of each of these.
/// Empty if there is none. Where a term of the type acts already, it does not act twice.
std::vector<EffectSite> sites_of(const PlantSpec& plant, const TermType& type);

/// "slide against the housing", "motor and input shaft"
std::string describe(const EffectSite& site);

}  // namespace rvbench::sim
