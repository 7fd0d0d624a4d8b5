#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "hal/recording_file.hpp"

namespace rvbench::test {

/// What left the sensors, sample by sample, whatever became of it on its way.
struct PlantTruth {
  static constexpr std::size_t channels = 3;

  struct Torque {
    float torque_Nm = 0;
    std::int32_t angle_counts = -1;  ///< of 65536 to the turn; below 0: nothing was sent
  };

  std::vector<float> scans;     ///< row by row, as they were handed to the driver
  std::vector<Torque> torques;  ///< by the number of the sample

  /// To hand it from one process to another. @throws std::runtime_error if that cannot be
  void save(const std::filesystem::path& file) const;
  static PlantTruth load(const std::filesystem::path& file);

  /// What is wrong with a record of it; empty if it is what was sampled, bit for bit. Samples that
  /// the record says were lost are no contradiction in the torque: frames get lost on their way.
  std::string contradiction(const Recording& record) const;
};

}  // namespace rvbench::test
