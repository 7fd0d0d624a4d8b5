#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/compare/record_levels.hpp"
#include "analysis/kinematics.hpp"
#include "analysis/spectrum.hpp"
#include "bench/recordings_to_judge.hpp"
#include "bench/run_recordings.hpp"
#include "hal/formats/read_recordings.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// One side of a comparison: a run folder, a recording of any format that `judge` reads, or a
/// folder of such recordings. A run folder is read record by record, as often as one is asked for.
class CompareSide {
 public:
  /// @param hints  of plain recordings only
  /// @return refused: what `judge` refuses; a run folder whose kinematics.json is damaged, that is
  ///         still at work, or that has no record; a folder of run folders
  /// @throws Interrupted between two plain recordings, if `stop` is requested
  static std::variant<CompareSide, JudgeRefusal> open(const std::string& path,
                                                      const hal::RecordingHints& hints,
                                                      const std::stop_token& stop = {});

  const std::string& path() const { return path_; }
  /// That of a run folder; a plain recording does not know its machine.
  const std::optional<analysis::Kinematics>& kinematics() const { return kinematics_; }
  /// Whether it states speed and rate by itself, whatever the hints say.
  bool is_run() const { return run_.has_value(); }
  /// Whether any record has a channel that the files call so; the error of one that cannot be read.
  Result<bool> has_channel(const std::string& name);
  /// Files that are not read: copies of others.
  const std::vector<analysis::NotCompared>& left_out() const { return left_out_; }
  std::size_t size() const { return points_.empty() ? records_.size() : points_.size(); }
  /// @param index  below size()
  Result<Recording> read(std::size_t index);
  /// From now on a channel that the files call `from` is read as `to`.
  void rename(const std::string& from, const std::string& to) { names_[from] = to; }
  /// Order spectrum of a channel, the mean in power over these records.
  /// @return nothing if none of them has one
  std::optional<analysis::Spectrum> mean_spectrum(const std::vector<std::size_t>& records,
                                                  const std::string& channel,
                                                  const analysis::Kinematics& kinematics);
  /// Files that were read, each with its SHA-256.
  const std::vector<std::pair<std::string, std::string>>& hashes() const { return hashes_; }

 private:
  static std::variant<CompareSide, JudgeRefusal> open_run(const std::filesystem::path& folder);
  static std::variant<CompareSide, JudgeRefusal> open_files(const std::filesystem::path& path,
                                                            const hal::RecordingHints& hints,
                                                            const std::stop_token& stop);

  std::string path_;
  std::optional<analysis::Kinematics> kinematics_;
  std::vector<std::pair<std::string, std::string>> hashes_;
  std::vector<analysis::NotCompared> left_out_;
  std::vector<Recording> records_;  ///< of plain recordings
  std::vector<int> points_;         ///< of a run: those recorded
  std::optional<RunRecordings> run_;
  std::map<std::string, std::string> names_;  ///< as in the files → as they are read
};

/// Whether lines of the one are lines of the other, whatever the machines are called.
bool is_same_machine(const analysis::Kinematics& a, const analysis::Kinematics& b);

}  // namespace rvbench::bench
