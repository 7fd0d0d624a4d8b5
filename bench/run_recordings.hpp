#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/recording_file.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// File names of the recordings in a run folder, in the order they were made.
std::vector<std::string> recording_names(const std::filesystem::path& folder);

/// Removes the last recordings of a folder as long as they hold neither a sample nor a point that
/// ended: what a run leaves that was stopped before its first record.
Status drop_empty_recordings(const std::filesystem::path& folder);

/// The recordings of one run folder as one: recording.h5, and recording-2.h5 and so on where the
/// run was resumed. A point that was recorded twice is the later one.
class RunRecordings {
 public:
  /// Repairs what a killed run left behind. A folder without a recording has no points.
  static Result<RunRecordings> open(const std::filesystem::path& folder);

  int points() const { return points_; }  ///< planned
  bool has(int point) const { return ended_.contains(point); }
  int next_point() const { return next_point_; }  ///< the one interrupted, or after the last
  /// The point at which the run was last resumed, if it was.
  std::optional<int> resumed_at_point() const { return resumed_at_point_; }
  Result<Recording> read(int point);

  /// The name that the next recording of the folder gets.
  std::string next_name() const;

 private:
  std::vector<std::unique_ptr<hal::RecordingReader>> readers_;
  std::map<int, std::size_t> ended_;  ///< point → reader
  int points_ = 0;
  int next_point_ = 0;
  std::optional<int> resumed_at_point_;
};

}  // namespace rvbench::bench
