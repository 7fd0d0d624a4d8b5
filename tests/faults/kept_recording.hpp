#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/recording_file.hpp"
#include "tests/faults/plant_truth.hpp"
#include "tests/faults/record_flaw.hpp"

namespace rvbench::test {

/// A recording on a real disk that may fill up, and what the sequencer was told of it: a point
/// whose end was acknowledged must be there whatever comes.
class KeptRecording final : public hal::RecordingWriter {
 public:
  /// @throws std::runtime_error if the file cannot be had
  KeptRecording(const std::filesystem::path& file, const hal::RecordingLayout& layout);

  Status append(int point, const hal::AccelerationBlock& block) override;
  Status append(int point, const hal::TorqueBlock& block) override;
  Status end_point(const hal::PointResult& result) override;
  Status note(double time_s, const std::string& event) override;
  Status close() override;

  const std::vector<hal::PointResult>& acknowledged() const { return acknowledged_; }

  bool disk_full = false;
  bool acknowledges_early = false;  ///< an end is written before the next point begins, not at once

 private:
  Status write_belated_end();

  std::unique_ptr<hal::RecordingWriter> writer_;
  std::vector<hal::PointResult> acknowledged_;
  std::optional<hal::PointResult> belated_end_;
};

/// What is on the disk after a run.
struct ReadBack {
  std::vector<std::string> losses;  ///< of what was acknowledged, or not as it was sampled
  std::string flaw;                 ///< the first that `check` finds in a point that is "ok"
};

ReadBack read_back(const std::filesystem::path& file,
                   const std::vector<hal::PointResult>& acknowledged, const PlantTruth& truth,
                   const RecordCheck& check);

/// In memory, where the system has such.
std::filesystem::path where_recordings_are_kept();

}  // namespace rvbench::test
