#pragma once

#include "analysis/kinematics.hpp"
#include "analysis/order/over_angle.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {

/// Turns that spectra of a machine are made of: whole periods of its gear train, four at least,
/// which part all of its lines, and 64 turns at least. So records of any length have one
/// resolution.
/// Units  turns of the input shaft. Errors  none thrown. Source  ours; four: lines_to_part
int block_turns(const Kinematics& kinematics);

/// Turns after which the gear train repeats; 1 where that is no whole number.
/// Units  turns of the input shaft. Errors  none thrown. Source  ours, of Kinematics::period_turns
double whole_period(const Kinematics& kinematics);

/// A channel over whole periods of the angle, with as many samples as there were in time.
/// Shape, units, errors, source  of over_angle()
OverAngle over_periods(const Channel& x, const ShaftAngle& angle, const Kinematics& kinematics);

/// Order spectrum as the mean, in power, of Hann blocks of so many turns, each half a block after
/// the last; without lines if not one fits.
///
/// Shape, units, errors  of order_map()
/// Source  Welch, IEEE Trans. Audio Electroacoust. 15(2), 70-73 (1967)
Spectrum block_spectrum(const OverAngle& x, const ShaftAngle& angle, int turns);

}  // namespace rvbench::analysis
