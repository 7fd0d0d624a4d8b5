#pragma once

#include <string>
#include <vector>

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// A type of effect that is a deviation of parts which the plant holds already: it gives its
/// parameters to terms of another type, under the same names.
/// @param of_type  the type of those terms
/// @param each     true: of one such term at a time; false: of all alike
TermType retuning(TermCard card, std::string of_type, bool each,
                  std::vector<ParameterCard> parameters);

/// An amplitude in m that deviates from the drawing by a few µm.
ParameterCard deviation_card(std::string name);
/// Where a wave stands: of a deviation, on its part.
ParameterCard phase_card(std::string name);
/// Where on its part a local deviation stands.
ParameterCard place_card(std::string name);

}  // namespace rvbench::sim
