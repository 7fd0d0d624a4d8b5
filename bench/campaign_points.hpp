#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/campaign.hpp"

namespace rvbench::bench {

/// Whether a recording is a point of a run: its plan says speed and load.
bool is_point(const Recording& recording);

/// Whether it is a point that cannot be used: "unsettled", "interrupted", ...
bool has_no_sound_end(const Recording& recording);

/// Adds a point as a record of its own. Its planned speed and load are its condition, and records
/// of one condition repeat each other. A point that has no sound end is left out, with a note.
void add_point(Campaign& campaign, Recording point);

/// Why a folder cannot be explained: it is no run's, the run is not finished, or a file is not what
/// the run left; explain's own files may be. Empty if it can.
std::vector<std::string> run_faults(const std::filesystem::path& folder);

/// What was measured in a run: the points of its folder.
/// @param wanted  see read_campaign()
CampaignOrRefusal campaign_of_run(const std::filesystem::path& folder,
                                  const std::vector<std::string>& wanted);

}  // namespace rvbench::bench
