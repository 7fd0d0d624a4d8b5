#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace rvbench {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// What one sampled signal is: all that is needed to read it years later, but for the samples.
struct ChannelInfo {
  std::string name;                ///< role on the bench: "accel_1x", "input_torque", "input_angle"
  std::string unit;                ///< SI symbol: "m/s²", "N·m", "rad"; empty if not known
  std::string direction;           ///< "+X", "-Z"; empty if it has none
  double sensitivity = not_known;  ///< of the sensor, V per `unit`; NaN if not known
};

/// One uniformly sampled signal.
struct Channel {
  ChannelInfo info;
  double rate_Hz = 0;                     ///< > 0
  double start_s = 0;                     ///< time of samples[0] on the rig's clock
  Eigen::VectorXd samples;                ///< N values in info.unit; NaN where the device gave none
  double time_uncertainty_s = not_known;  ///< of start_s
};

/// The channel of that name; nullptr if there is none.
inline const Channel* find_channel(const std::vector<Channel>& channels, std::string_view name) {
  for (const Channel& channel : channels) {
    if (channel.info.name == name) return &channel;
  }
  return nullptr;
}

/// What was measured at one point of the plan, or in one file of another program.
struct Recording {
  std::string source;  ///< "runs/A17/.../recording.h5#012", "IR007_0.mat"
  double planned_speed_rpm = not_known;
  double speed_rpm = not_known;  ///< measured mean speed of the input shaft
  double load_pct = not_known;   ///< of rated output torque, as planned
  double torque_Nm = not_known;  ///< measured mean input torque
  int repeat = 0;                ///< 1, 2, ... ; 0 if it is not part of a matrix
  std::string status;            ///< "ok", or why the record cannot be used
  std::vector<Channel> channels;
  std::vector<std::string> notes;  ///< how the file was read, where it was not obvious

  /// The channel of that name; nullptr if there is none.
  const Channel* find(std::string_view name) const { return find_channel(channels, name); }
};

/// Names that analysis looks for. Accelerations are all channels in m/s² (or of unknown unit).
namespace channel_names {
inline constexpr std::string_view input_angle = "input_angle";      ///< rad, unwrapped
inline constexpr std::string_view input_torque = "input_torque";    ///< N·m
inline constexpr std::string_view output_angle = "output_angle";    ///< rad, unwrapped
inline constexpr std::string_view output_torque = "output_torque";  ///< N·m
}  // namespace channel_names

/// Whether it is angle or torque of a shaft: they have a clock of their own.
inline bool is_of_shaft(const ChannelInfo& channel) {
  using namespace channel_names;
  return channel.name == input_angle || channel.name == input_torque ||
         channel.name == output_angle || channel.name == output_torque;
}

}  // namespace rvbench
