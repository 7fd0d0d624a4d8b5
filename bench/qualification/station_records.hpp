#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "bench/ledger.hpp"
#include "bench/qualification/self_test_step.hpp"
#include "hal/types/recording.hpp"

/// What a station has shown, beside the runs that it is for: one file a record in
/// <root>/qualification/, in the order of the ledger. None is ever changed but that a self-test has
/// begun, which is replaced by what it came to. results.db has them too, as an index.
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

/// A self-test that came to an answer, or, without steps, one that has begun: if it is killed, it
/// was not passed.
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

  bool has_ended() const { return !steps.empty(); }
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
std::string calibration_of(const std::string& channel);  ///< with what every one begins
std::string calibration_kind(const std::string& channel, const std::string& certificate);

/// Where they lie.
std::filesystem::path qualification_folder(const std::filesystem::path& root);

/// Those of every station that are as they were kept; the others are left out, and told where no
/// record of the same came after.
StationRecords read_station_records(const std::filesystem::path& root);
/// Without those of these files, which are known already and are not even read.
StationRecords further_station_records(const std::filesystem::path& root,
                                       const std::set<std::string>& known);
/// Of each certificate and each station's kind of rig the one that was kept last, by a ledger that
/// was read while nothing was kept, and still is not: LedgerReading.
StationRecords newest_station_records(const std::filesystem::path& root, const Ledger& ledger);

// All are on the disk and in the ledger when these return. @throws std::system_error

/// A further file. @return its name in the folder
std::string keep_record(const std::filesystem::path& root, const CalibrationRecord& record);

/// That a self-test begins, which has not been passed until keep_end(): a further file, the
/// record's. Of two at once the one counts that comes to its end last.
SelfTestRecord keep_begin(const std::filesystem::path& root, SelfTestRecord record);
/// What it came to, in place of that it began.
void keep_end(const std::filesystem::path& root, const SelfTestRecord& record);
/// It says nothing of the station, for somebody stopped it: the one before it counts again.
void take_back(const std::filesystem::path& root, const SelfTestRecord& begun);

/// That somebody says that this computer's clock is right, whatever the ledger's last line is of: a
/// further file. @return its name
std::string keep_clock_record(const std::filesystem::path& root, const std::string& by);

}  // namespace rvbench::bench
