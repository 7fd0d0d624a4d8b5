#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// A place where a tachometer did not give one pulse for each mark of the shaft.
struct TachometerFault {
  enum class Kind { missing, extra };
  Kind kind = Kind::missing;
  double time_s = 0;  ///< of the extra pulse, or of the pulse before the gap
  int pulses = 1;     ///< missing in the gap; 1 of an extra one
};

/// What the pulses of a tachometer tell.
struct TachometerReading {
  std::optional<ShaftAngle> angle;      ///< turns 0 at the first pulse that counts; see `why_not`
  std::string why_not;                  ///< why there is no angle; empty if there is one
  std::vector<TachometerFault> faults;  ///< put right in the angle, in order of time
};

/// Shaft angle from the times of pulses. A pulse that comes after less than 0.6 of the interval
/// that its neighbours agree on is an extra one, and left out; a gap of 1.6 intervals and more lost
/// pulses, and is counted as the whole number of intervals that it is next to. Both are marked.
///
/// Shape    times in rising order → an angle at even times, 16 for each interval on average; a
///          natural spline goes through the pulses
/// Units    s, marks per turn
/// Errors   no angle, and why not: fewer than 8 pulses, times that do not rise, more than 5 % of
///          them at fault, an interval that fits no whole number (the speed changed too fast).
///          Throws std::invalid_argument: pulses_per_turn below 1, a time not finite
/// Limits   h the interval: speed ripple faster than 1/(2h) is not seen; away from the ends the
///          angle is off by (5/384)·h⁴·max|θ⁗| + a·h²/2048, a the acceleration. Marks that are not
///          evenly spaced look like ripple once per turn
/// Source   Fyfe & Munck, Mech. Syst. Signal Process. 11(2), 187-205 (1997); the faults are ours
TachometerReading read_tachometer(const std::vector<double>& pulse_times_s, int pulses_per_turn);

}  // namespace rvbench::analysis
