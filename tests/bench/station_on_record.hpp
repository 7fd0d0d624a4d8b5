#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/qualification/qualification.hpp"
#include "tests/support/scratch_folder.hpp"

/// A station of which a self-test and a calibration are asked, and what it has on record.
namespace rvbench::test {

inline const std::string now = "20261127T120000Z";
inline const std::vector<ChannelInfo> channels{{"accel_1x", "m/s²", "+X", 0.0102},
                                               {"input_torque", "N·m", "", not_known}};

inline bench::SelfTestRecord tested(const std::string& utc, bool passed = true) {
  return {.file = "",
          .station = "EOL 3",
          .rig_kind = "bench",
          .utc = utc,
          .software = "0.1.0",
          .passed = passed,
          .reason = passed ? "every step passed" : "tap: fail",
          .judged_by = bench::limits_of(bench::SelfTestSpec{}),
          .steps = {
              {"tap", passed ? bench::SelfTestWord::passed : bench::SelfTestWord::failed, "", {}}}};
}

inline bench::CalibrationRecord certified(const std::string& until, double sensitivity = 0.01021) {
  return {.file = "",
          .station = "EOL 3",
          .channel = "accel_1x",
          .sensitivity = sensitivity,
          .certificate = "K-4711",
          .by = "J. Weber",
          .calibrated_utc = "20251128T000000Z",
          .valid_until_utc = until,
          .entered_utc = "20251201T080000Z",
          .software = "0.1.0"};
}

inline bench::QualificationSection asks_for_self_test() {
  bench::QualificationSection section;
  section.station = "EOL 3";
  section.rig_kind = "bench";
  section.self_test.emplace();
  return section;
}

inline bench::QualificationSection asks_for_calibration() {
  bench::QualificationSection section;
  section.station = "EOL 3";
  section.calibration = bench::CalibrationDemand{{"accel_1x"}};
  return section;
}

/// From its begin to its end. @return its file's name
inline std::string keep_self_test(const std::filesystem::path& root, bench::SelfTestRecord record) {
  record.file = bench::keep_begin(root, record).file;
  bench::keep_end(root, record);
  return record.file;
}

// What a folder of runs comes to at `now`, a line each.
inline std::string reasons_in(const ScratchFolder& root,
                              const bench::QualificationSection& section) {
  bench::StationEvidence evidence = bench::gather_evidence(root.path(), section);
  std::string told;
  for (const std::string& reason :
       bench::qualification_of(section, channels, evidence, now).reasons()) {
    told += reason + "\n";
  }
  return told;
}

}  // namespace rvbench::test
