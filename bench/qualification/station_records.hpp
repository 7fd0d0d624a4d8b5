#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "bench/ledger.hpp"
#include "bench/qualification/self_test_step.hpp"
#include "hal/types/recording.hpp"

/// What a station has shown, beside the runs that it is for: one file a record in
/// <root>/qualification/, never changed, in the order of the ledger. results.db has them too, as an
/// index.
namespace rvbench::bench {

inline constexpr const char* qualification_folder_name = "qualification";

/// A sensor's calibration, as somebody entered it from its certificate.
struct CalibrationRecord {
  std::string file;  ///< its name in the folder
  std::string station;
  std::string channel;
  double sensitivity = not_known;  ///< V per unit of the channel; NaN: the certificate states none
  std::string certificate;         ///< its number
  std::string by;                  ///< who entered it
  std::string calibrated_utc;      ///< "20261101T000000Z": the day begins
  std::string valid_until_utc;     ///< "20271031T235959Z": the day ends
  std::string entered_utc;
  std::string software;
};

/// A self-test that came to an answer.
struct SelfTestRecord {
  std::string file;
  std::string station;
  std::string rig_kind;  ///< that was tested: "bench", "sim"
  std::string utc;
  std::string software;
  bool passed = false;
  std::string reason;
  std::string judged_by;  ///< limits_of() what was asked then
  std::vector<SelfTestResult> steps;
};

/// A record that may be the newest of its kind and says nothing any more, or one that nobody kept.
struct DamagedRecord {
  std::string station;   ///< empty: nobody can tell
  std::string kind;      ///< of its line in the ledger, or of that it should have; empty likewise
  std::string sentence;  ///< with what is to be done
};

struct StationRecords {
  std::vector<CalibrationRecord> calibrations;  ///< in the order they were entered
  std::vector<SelfTestRecord> self_tests;       ///< in the order they were made
  std::vector<DamagedRecord> damaged;
  std::string clock_fault;  ///< clock_fault() of their ledger
};

// The kinds of lines in the ledger.
std::string self_test_kind(const std::string& rig_kind);
std::string calibration_kind(const std::string& channel, const std::string& certificate);

/// Where they lie.
std::filesystem::path qualification_folder(const std::filesystem::path& root);

/// Those of every station that are as they were kept; the others are left out, and told where no
/// record of the same came after.
StationRecords read_station_records(const std::filesystem::path& root);
/// By a ledger that was read while nothing was kept, and still is not: LedgerReading.
StationRecords read_station_records(const std::filesystem::path& root, const Ledger& ledger);

// Each makes a further file, on the disk and in the ledger when it returns, and never replaces one.
// @return its name in the folder @throws std::system_error
std::string keep_record(const std::filesystem::path& root, const CalibrationRecord& record);
std::string keep_record(const std::filesystem::path& root, const SelfTestRecord& record);
/// That somebody says that this computer's clock is right, whatever the ledger's last line is of.
std::string keep_clock_record(const std::filesystem::path& root, const std::string& by);

}  // namespace rvbench::bench
