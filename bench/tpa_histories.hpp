#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/tpa/path_histories.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// What each path adds to each target as time goes on.
struct ContributionsOverTime {
  double duration_s = 0;
  double reach_back_s = 0, reach_ahead_s = 0, cut_share = 0;  ///< of PathHistories
  std::vector<Eigen::MatrixXd> rms;  ///< one per target: paths x stretches of equal length
};

/// Histories of a motion from its recording; nullopt where the sample rate does not go with the
/// lines. The recording has the inputs: spectra were taken of it.
std::optional<analysis::PathHistories> histories_of(
    const analysis::PathContributions& contributions, const Recording& recording);

/// The same in stretches, for a map.
std::optional<ContributionsOverTime> contributions_over_time(
    const analysis::PathContributions& contributions, const Recording& recording);

/// What channels of histories are called, and their units.
struct HistoryLabels {
  std::string input;  ///< "force at ", before the path's point
  std::string input_unit, target_unit;
};

/// Writes histories in rvbench's own format: a channel per force, "force at J3 active", and one per
/// contribution, "flange by J3 active +X", with the direction of path or target.
/// @return why not: the recording cannot be read again, its rate does not go with the lines, the
///         file exists or cannot be written
Status write_histories(const std::filesystem::path& file,
                       const analysis::PathContributions& contributions,
                       const std::string& recording, const HistoryLabels& labels);

}  // namespace rvbench::bench
