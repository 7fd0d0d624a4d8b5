#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// The table of results, which lies beside the folders of the serials.
inline constexpr const char* result_database_name = "results.db";

/// One point of the matrix (or one stored file), judged.
struct JudgedPoint {
  std::string status = "ok";  ///< "not_recorded", or as the recording says: "unsettled", ...
  double planned_speed_rpm = not_known;
  double torque_Nm = not_known;                        ///< measured mean input torque
  double acceleration_time_uncertainty_s = not_known;  ///< of when, on the rig's clock
  double torque_time_uncertainty_s = not_known;        ///< likewise, of torque and angle
  analysis::Examination examination;
};

/// A limit of the plan, held against what was measured.
struct LimitCheck {
  std::string measure;
  std::string component;  ///< empty: any
  std::string unit;
  double max = 0;
  double measured = not_known;  ///< the worst; NaN if nothing could be measured
  std::string where;            ///< the point and channel of the worst
  bool passed = false;
  std::string why;
};

/// Circumstances of a run; of a stored recording only `software` and `started_utc` are known.
struct RunFacts {
  std::string serial;
  std::string started_utc;
  std::string plan;
  std::string rig;
  std::string preset;
  std::optional<std::uint64_t> seed;
  std::string software;
  double duration_s = not_known;  ///< of the rig's time
  int drive_retries = 0;
  bool shaft_stopped = false;
  bool brake_released = false;
  /// A thread hangs in a call of the rig's, the log's or the screen's: the process must exit
  /// without destroying what that thread uses. Not in the files.
  bool must_exit = false;
  bool log_hung = false;  ///< it is the log's, which knows of no event any more. Not in the files
  std::optional<int> resumed_at_point;
  std::vector<std::pair<double, std::string>> events;
};

/// Everything a run or a judgement came to: verdict.json in C++.
struct Judgement {
  Ending ending;
  RunFacts facts;
  std::string machine;
  analysis::Diagnosis diagnosis;
  std::vector<LimitCheck> limits;
  std::vector<JudgedPoint> points;
  std::vector<std::string> unwritten;  ///< result files that are missing, and why; not in them
};

/// A name that is safe as one path component. Characters other than letters, digits, '.', '_' and
/// '-' become '_' and a short hash keeps different serials apart, and from results.db beside them.
/// @throws std::invalid_argument if `serial` is empty
std::string folder_name_of(const std::string& serial);

/// How a run began: start.json of its folder.
struct RunBegin {
  std::string serial;
  std::string started_utc;
  int number = 0;  ///< among the runs of that serial, from 1: clocks may be set back
};

/// Counted on from the runs that are there.
RunBegin next_run(const std::filesystem::path& root, const std::string& serial,
                  const std::string& utc);

std::string run_begin_to_json(const RunBegin& begin);

/// Of a folder without start.json the number is 0, and names stand for serial and time.
RunBegin read_run_begin(const std::filesystem::path& run);

/// Makes <root>/<folder_name_of(serial)>/<utc>/, on the disk when this returns; a folder that
/// exists is never used again.
/// @throws std::system_error
std::filesystem::path create_run_folder(const std::filesystem::path& root,
                                        const std::string& serial, const std::string& utc);

/// Whether a run came to PASS, FAIL or INVALID, with all of its files.
bool is_finished(const std::filesystem::path& run);

/// The run of that serial that began last, by its number, if it did not come to PASS, FAIL or
/// INVALID with all of its files.
std::optional<std::filesystem::path> newest_unfinished_run(const std::filesystem::path& root,
                                                           const std::string& serial);

/// "20261121T114559Z"
std::string utc_now();

/// "runs/A17: Read-only file system": what the system says, without the words of the library.
std::string reason_of(const std::system_error& error);

/// Replaces the file in one step: after a crash it holds the old text or the new one, after this
/// has returned the new one. If that fails, no draft is left behind.
/// @throws std::system_error
void write_file(const std::filesystem::path& file, const std::string& text);

/// Where write_file() drafts the new text. A kill may leave it there.
std::filesystem::path draft_of(const std::filesystem::path& file);

/// The text of a regular file; nullopt if it is none or cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& file);

}  // namespace rvbench::bench
