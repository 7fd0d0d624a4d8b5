#pragma once

#include <cstddef>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/kinematics.hpp"
#include "analysis/order/order_lines.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// That are listed of a spectrum, whatever they lie on.
inline constexpr std::size_t most_lines = 40;

/// Lines of the order spectrum of x that noise alone would not raise once in a thousand spectra,
/// strongest first, each with what the kinematics calls it: the `most` strongest, and those on a
/// characteristic order however weak.
///
/// A line is explained if it is a harmonic of a characteristic order, or a sideband of a mesh line
/// at up to three times the order of a shaft. Orders must agree within 0.6 lines, and 0.3 ‰ where
/// the speed was stated instead of measured. Of others may_be() is asked.
///
/// Shape   none if less than one period, or 64 samples of it, are there
/// Units   orders, Hz, that of the channel
/// Errors  throws std::invalid_argument of amplitude_spectrum(): sample not finite
/// Source  standing_lines() for the lines; what they are called is ours
std::vector<SpectralLine> spectral_lines(const Channel& x, const ShaftAngle& angle,
                                         const Kinematics& kinematics,
                                         std::size_t most = most_lines);

/// The same of a channel that was transformed already.
/// Shape, units, source  as above. Errors  none thrown: OrderLines has seen the samples
std::vector<SpectralLine> spectral_lines(const OrderLines& x, const Kinematics& kinematics,
                                         std::size_t most = most_lines);

/// Whether the line lies on a characteristic order itself, not on a harmonic or a sideband: told by
/// its meaning. Nothing is thrown. Source  meaning_of()
bool is_characteristic(const SpectralLine& line, const Kinematics& kinematics);

/// Whether the order may be the first harmonic of a part that slips.
/// Units   orders of the input shaft. Errors  none thrown. Source  slip of the signatures
bool slips(double order, const Kinematics& kinematics);

/// What the kinematics calls this order; empty if it has no word for it.
/// @param near  how far orders may differ and still be the same
/// Units   orders of the input shaft
/// Errors  none thrown
/// Source  ours; sidebands of a mesh: McFadden, J. Vib. Acoust. 108(2), 165-170 (1986)
std::string meaning_of(double order, double near, const Kinematics& kinematics);

/// What the order may be though no characteristic order is there: up to the third harmonic of a
/// rolling element's that slips, as "may be bearing inner race x2"; empty if it is none. That is no
/// more than a hint: a few percent of slip reach many orders, and is_characteristic() is false of
/// it.
/// Units   orders of the input shaft. Errors  none thrown. Source  slip of the signatures
std::string may_be(double order, const Kinematics& kinematics);

/// Unexplained lines that are harmonics of a common fundamental, or sidebands of a mesh line at up
/// to three times it, become one line each: the fundamental's, with the strongest amplitude, and
/// with what was seen as its meaning, as "x1, x3, pinion mesh - 1x". Strongest first.
/// Shape, units, errors  those of the lines, no more than they are; nothing thrown
/// Source  ours; line_families() asks the same without kinematics, and with a p-value
std::vector<SpectralLine> families(std::vector<SpectralLine> unexplained,
                                   const Kinematics& kinematics);

}  // namespace rvbench::analysis
