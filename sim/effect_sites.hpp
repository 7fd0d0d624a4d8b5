#pragma once

#include <vector>

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// Every place of a plant where an effect of this type may act, by its gate: each body against the
/// housing, each pair of bodies that a term joins, with each input, term or body it may refer to.
/// An effect that only replaces terms of one type is tried in the place of each of these.
/// Of an effect that is in a sensor, every channel that may have it.
/// Empty if there is none. Where a term of the type acts already, it does not act twice: nor in a
/// channel that hums at any frequency, nor under a sensor that sits on a mount.
std::vector<EffectSite> sites_of(const PlantSpec& plant, const TermType& type,
                                 const TermLibrary& library = standard_terms());

/// "slide against the housing", "motor and input shaft", "input_torque channel",
/// "planet_1 and carrier, planet_2 and carrier alike"
std::string describe(const EffectSite& site);

/// Unit that a parameter of an effect has there: by the motion of its body, or of its channel.
std::string unit_at(const PlantSpec& plant, const EffectSite& site, UnitKind kind);

/// The size of a parameter that matters there: natural_scale(), and in a channel what it makes of
/// that.
double natural_scale_at(const PlantSpec& plant, const EffectSite& site, UnitKind kind,
                        const NaturalScales& scales);

}  // namespace rvbench::sim
