#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/qualification/golden_evidence.hpp"
#include "bench/qualification/qualification_section.hpp"
#include "bench/qualification/station_records.hpp"
#include "bench/rig_file.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// What there is to hold against a rig file's "qualification".
struct StationEvidence {
  StationRecords records;
  GoldenEvidence golden;
};

/// Of the folder of runs. The golden unit's runs are those of the ledger; what they measured is
/// looked for in results.db once that holds every run, as far as it was made of what the ledger
/// has.
StationEvidence gather_evidence(const std::filesystem::path& root,
                                const QualificationSection& section);

/// How far one thing that is asked of the station is fulfilled.
struct RequirementState {
  std::string requirement;  ///< "self_test", "calibration of accel_1x", "golden_unit", "records"
  std::string word;         ///< "fulfilled", "expires", "missing", "expired", "failed"
  std::string sentence;
  bool blocks = false;  ///< no unit can pass before that is mended
};

struct Qualification {
  std::vector<RequirementState> requirements;

  std::vector<std::string> reasons() const;   ///< of those that block
  std::vector<std::string> warnings() const;  ///< what will block before long
  /// ERROR, not_qualified, with all reasons; nothing if the station is qualified.
  std::optional<Ending> refusal() const;
};

/// What a rig file asks, against what the station has shown.
///
/// @param channels  of the rig, with the sensitivities that it goes by: channels_of()
/// @param serial    of the unit that is to be tested: the golden unit's own run does not wait for
///                  the golden unit
Qualification qualification_of(const QualificationSection& section,
                               const std::vector<ChannelInfo>& channels,
                               const StationEvidence& evidence, const std::string& now_utc,
                               const std::string& serial = "");

/// The same of a rig file and its folder of runs, now; nothing is asked of most rigs.
Qualification qualification_now(const RigFile& rig, const std::filesystem::path& root,
                                const std::string& serial = "");

}  // namespace rvbench::bench
