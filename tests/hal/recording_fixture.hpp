#pragma once

#include <cmath>
#include <string>

#include "hal/recording_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {

inline hal::RecordingLayout layout_of(int points, int channels) {
  hal::RecordingLayout layout;
  layout.points.assign(static_cast<std::size_t>(points), {605, 50, 1});
  for (int i = 0; i < channels; ++i) {
    layout.acceleration_channels.push_back(
        {"accel_" + std::to_string(i + 1), "m/s²", i % 2 == 0 ? "+X" : "-Z", 0.01});
  }
  layout.acceleration_rate_Hz = 4960;
  layout.acceleration_range_m_s2 = 500;
  layout.torque_rate_Hz = 1000;
  layout.software = "rvbench test";
  return layout;
}

/// Values that a float holds exactly, each at one place only (while scan < 2^20).
inline double acceleration_m_s2(int scan, int channel) { return scan + channel * 0.0625; }
inline double torque_Nm(int sample) { return 3 + 0.001 * sample; }
inline double angle_rad(int sample) { return 1e5 + sample * 0.0633; }

inline hal::AccelerationBlock acceleration_block(double t0_s, int first, int scans, int channels) {
  hal::AccelerationBlock block;
  block.t0_s = t0_s;
  block.scans.resize(scans, channels);
  for (int i = 0; i < scans; ++i) {
    for (int c = 0; c < channels; ++c) {
      block.scans(i, c) = static_cast<float>(acceleration_m_s2(first + i, c));
    }
  }
  return block;
}

inline hal::TorqueBlock torque_block(double t0_s, int first, int samples) {
  hal::TorqueBlock block;
  block.t0_s = t0_s;
  for (int i = first; i < first + samples; ++i) {
    block.samples.push_back({torque_Nm(i), angle_rad(i)});
  }
  return block;
}

}  // namespace rvbench::test
