#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "hal/recording_file.hpp"

namespace rvbench::test {

/// The samples of one sample clock, counted and summed up (CRC-32) as a recording keeps them.
struct SampleSum {
  std::uint32_t count = 0;  ///< scans, or samples of torque and angle
  std::uint32_t sum = 0;

  void add(const hal::AccelerationBlock& block);
  void add(const hal::TorqueBlock& block);
  bool operator==(const SampleSum&) const = default;
};

SampleSum accelerations_in(const Recording& record);
SampleSum torques_in(const Recording& record);  ///< torque and angle

/// Has told (tell(), Witness) what is recorded: "begun <file>", "handed <point> a|t <count> <sum>"
/// when a block is handed over, "ended <point> <count> <sum> <count> <sum>" when the end of a point
/// was acknowledged.
std::unique_ptr<hal::RecordingWriter> watched(std::unique_ptr<hal::RecordingWriter> writer,
                                              const std::filesystem::path& file);

}  // namespace rvbench::test
