#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/compare/quantities.hpp"
#include "analysis/compare/slipping_lines.hpp"
#include "analysis/shaft_angle.hpp"

namespace rvbench::analysis {

/// One quantity of one channel of one record: 20·log10 of its value in its unit.
struct Level {
  double whole_dB = not_known;        ///< NaN where the record does not hold it
  Eigen::VectorXd parts_dB = {};      ///< of parts that share no sample; empty: too few
  double above_floor_dB = not_known;  ///< of a line: over the noise around it
  double p_value = 1;                 ///< of a line: noise alone shows as much
  double part_p_value = 0;            ///< likewise, of all lines of a part that slips
  bool taken = false;                 ///< what stands there is another part's: no level
};

struct ChannelLevels {
  ChannelInfo info;
  double rate_Hz = 0;
  double length_s = 0;
  std::vector<Level> levels;                 ///< one per quantity
  std::vector<SignaturePair> unparted = {};  ///< of find_slipping_lines()
};

/// Measures all quantities of a channel. Parts of a line are the periods of the gear train, without
/// a window, where it is locked to them; else blocks of block_turns(). Parts of a level are eighths
/// of the record. Fewer than three parts are none. A line that strays is read from what the average
/// over the gear train's periods leaves: lines of the train within its reach are none of it; and
/// where all lines of its part stand out together, unless that is another part's.
///
/// Shape   N samples → one level per quantity, in their order
/// Units   dB re 1 unit of the channel, re 1 for what has none; of a line its amplitude
/// Limits  of a line that strays, 1 / periods of the power is taken out with the train's; a record
///         shorter than block_turns() has levels only
/// Errors  throws std::invalid_argument: a sample is not finite, no sample
/// Source  signal_levels(), line_level(), without_average(), find_slipping_lines()
ChannelLevels measure_channel(const Channel& x, const ShaftAngle& angle,
                              const Kinematics& kinematics,
                              const std::vector<Quantity>& quantities);

}  // namespace rvbench::analysis
