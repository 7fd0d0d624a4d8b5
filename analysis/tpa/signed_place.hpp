#pragma once

#include <string>
#include <utility>

#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// A place whose direction is positive, and the sign that a value along the one that was stated has
/// along it: "-X" is "+X" with sign -1, "X" is "+X". No direction stays none.
struct SignedPlace {
  DegreeOfFreedom place;
  double sign = 1;
};

/// Units  none. Errors  none thrown. Source  definition
inline SignedPlace signed_place(DegreeOfFreedom place) {
  if (place.direction.empty()) return {std::move(place), 1};
  const char first = place.direction.front();
  if (first != '-' && first != '+') place.direction.insert(0, 1, '+');
  if (first == '-') place.direction[0] = '+';
  return {std::move(place), first == '-' ? -1. : 1.};
}

/// "J3 active +X". Errors  none thrown. Source  definition
inline std::string name_of(const DegreeOfFreedom& place) {
  return place.direction.empty() ? place.point : place.point + " " + place.direction;
}

}  // namespace rvbench::analysis
