#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/compare/channel_levels.hpp"
#include "analysis/kinematics.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// What is not compared, and why.
struct NotCompared {
  std::string where;  ///< "A17/recording.h5#003, accel_2z"
  std::string why;
};

/// A record that ends before its lines are parted: only its levels are compared.
struct ShortRecord {
  double length_s = 0;
  double needed_s = 0;  ///< of block_turns() at the speed of the record
  double speed_rpm = not_known;
};

/// One record as it is compared.
struct RecordLevels {
  std::string source;
  double speed_rpm = not_known;  ///< as planned; as measured where nobody planned
  double measured_rpm = not_known;
  double load_pct = not_known;
  std::vector<ChannelLevels> channels;  ///< those that can be trusted
  std::vector<NotCompared> left_out;
  std::optional<ShortRecord> too_short = {};
};

/// Measures all quantities in the acceleration channels of a record.
///
/// Shape   channels in the order of the record, one level per quantity in each
/// Units   those of measure_channel(); rpm, %
/// Errors  never throws for what was measured: what cannot be compared is left out, with the reason
/// Source  measure_channel(); what is not to be trusted: record_quality()
RecordLevels measure_levels(const Recording& record, const Kinematics& kinematics,
                            const std::vector<Quantity>& quantities);

}  // namespace rvbench::analysis
