#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "analysis/quality/heard.hpp"

namespace rvbench::analysis {

struct MainsHum {
  double grid_Hz = 0;          ///< as found, near 50 or 60
  std::vector<int> harmonics;  ///< 1, 3, ...: those that bear witness
  double rms = 0;              ///< of those
  double share = 0;            ///< of the rms of the channel, from 20 Hz on
};

/// Mains voltage in one channel's cable: a ground loop, a lost shield.
///
/// Hum is told from vibration by all of these together; each alone a machine may show:
/// * lines at g and at 3g, 5g or 7g, for one g within 0.2 Hz of 50 or 60 Hz (what ENTSO-E and NERC
///   keep to), each 100 times the noise around it: voltages of the grid are distorted in odd
///   harmonics. Even ones are left out, and must be weaker unless the machine has them: at 2g a
///   motor on the grid pulls its stator, and that is vibration.
/// * not lines of the machine: `is_of_machine` is asked about each. At 605 rpm order 5 is 50.4 Hz,
///   0.4 Hz from the grid: two Hann lobes, of two lines each, part them from 10 s on. In a shorter
///   record nothing is found.
/// * in this channel alone: ten times as strong as in the middle one of at least two others of its
///   unit, and ten times as strong against what else each hears. A machine that shakes at 50 Hz is
///   heard by all sensors, and a sensor near it hears more of everything.
/// * a tenth of the channel's rms or more: below, it spoils no verdict.
///
/// Limits  hum that more than half of the channels share is not found, nor that of a record of one
///         or two channels; nor hum whose odd lines fall on orders that the machine has
/// @param one            index of the channel in question
/// @param is_of_machine  (frequency_Hz, within_Hz): whether the kinematics has a word for it
/// Units   Hz; those of the channels. Errors  throws std::out_of_range: no such channel
/// Source  ours; EN 50160 for the odd harmonics that a grid's voltage may have
std::optional<MainsHum> find_mains_hum(const std::vector<Heard>& channels, std::size_t one,
                                       const std::function<bool(double, double)>& is_of_machine);

}  // namespace rvbench::analysis
