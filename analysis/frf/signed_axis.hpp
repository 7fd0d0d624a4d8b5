#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "hal/types/frequency_response.hpp"

namespace rvbench::analysis {

/// A direction without its sign: "-RX" is the axis "RX" against its sense. No sign is a plus.
struct SignedAxis {
  std::string axis;
  double sign = 1;
};

/// Units  none. Errors  none thrown: an empty direction is an axis without name
/// Source  definition
inline SignedAxis axis_of(const std::string& direction) {
  if (direction.starts_with('+')) return {direction.substr(1), 1};
  if (direction.starts_with('-')) return {direction.substr(1), -1};
  return {direction, 1};
}

/// +1 or -1 where both are on one axis of one point, in the same or the opposite sense; 0
/// elsewhere. Units  none. Errors  none thrown. Source  definition
inline double same_axis(const DegreeOfFreedom& a, const DegreeOfFreedom& b) {
  const SignedAxis one = axis_of(a.direction), other = axis_of(b.direction);
  return a.point == b.point && one.axis == other.axis ? one.sign * other.sign : 0;
}

/// Along the axis, not against it: "-X" and "X" are "+X". No direction stays none.
/// Units  none. Errors  none thrown. Source  definition
inline DegreeOfFreedom positive(const DegreeOfFreedom& place) {
  if (place.direction.empty()) return place;
  return {place.point, "+" + axis_of(place.direction).axis};
}

/// "J3 active +X". Errors  none thrown. Source  definition
inline std::string name_of(const DegreeOfFreedom& place) {
  return place.direction.empty() ? place.point : place.point + " " + place.direction;
}

inline bool holds(const std::vector<DegreeOfFreedom>& places, const DegreeOfFreedom& place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

}  // namespace rvbench::analysis
