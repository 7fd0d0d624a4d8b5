#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// What a campaign says of a stretch of a recording.
struct RecordLabels {
  std::string name;
  std::string condition;     ///< records of one condition are left out together
  std::string speed;         ///< "" if the speed is no condition
  std::string load;          ///< "" if the load is no condition
  std::string programme;     ///< records of one programme repeat each other; "" if none does
  bool learned_from = true;  ///< false: only predicted, never fitted
};

/// A stretch of a recording that is compared with a model.
struct CampaignRecord : RecordLabels {
  Eigen::Index lead_in = 0;  ///< samples before the stretch, for the model to come into step
  Recording recording;       ///< one rate, one length, with the lead-in
};

/// Recordings of one machine under several conditions.
struct Campaign {
  std::string name;
  std::vector<CampaignRecord> records;
  std::vector<std::pair<std::string, std::string>> hashes;  ///< file, SHA-256
  std::vector<std::string> notes;                           ///< what was done to the data
};

/// Why something cannot be compared: faults of a file, or, where that has none, of recordings.
struct Refusal {
  std::vector<hal::ConfigFault> faults;
  bool of_recordings = false;
};

using CampaignOrRefusal = std::variant<Campaign, Refusal>;

/// Adds a record; one whose name another has becomes "name (2)".
void add_record(Campaign& campaign, CampaignRecord record);

/// Reads a campaign file with the recordings it names, relative to itself.
///
///     {"campaign": "emps", "files": [{"file": "DATA_EMPS.mat", "rate_Hz": 1000,
///       "records": [{"from_s": 0, "to_s": 6.134, "condition": "cycle 1"}, ...]}]}
///
/// A file without "records" is cut into four conditions of equal length. `columns` names the
/// columns of a file that has no names; a `time_column` [s] that is not uniform is resampled at
/// rate_Hz, with a note; a column time_s is one where no rate is stated, or the same one, or where
/// rows are missing. `constants` are channels that never change, as {"load": {"value": 60, "unit":
/// "%"}}; `speed_from_vibration` makes a shaft's speed of a file's vibration (see VibrationSpeed).
/// A record without `to_s` goes to the end. A recording that is given twice is refused: nothing
/// could be left out of it. Points of a run are records of their own, see add_point().
/// @param wanted  names of channels, what drives the plant first: of a file with several clocks,
///                that of the first that is there is kept; empty: that of the longest
CampaignOrRefusal read_campaign(const std::string& path,
                                const std::vector<std::string>& wanted = {});

/// A campaign of bare recordings: each file one condition, or four of equal length if there is
/// only one; but points of a run as above.
/// @param rate_Hz  of files that do not state it; NaN if not known
CampaignOrRefusal campaign_of(const std::vector<std::string>& files, double rate_Hz,
                              const std::vector<std::string>& wanted = {});

}  // namespace rvbench::bench
