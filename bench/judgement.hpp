#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "hal/types/outcome.hpp"
#include "hal/types/set_point.hpp"

namespace rvbench::bench {

inline constexpr const char* not_recorded = "not_recorded";

/// One point of the matrix (or one stored file), judged.
struct JudgedPoint {
  std::string status = "ok";  ///< not_recorded, or as the recording says: "unsettled", ...
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
  double max = 0;               ///< NaN: it is a limit from below
  double measured = not_known;  ///< the worst; NaN if it could be measured nowhere
  std::string where;            ///< the point and channel of the worst
  bool passed = false;
  std::string why;
  std::string of = {};                    ///< the band, order or mesh it is narrowed to; empty: any
  double min = not_known;                 ///< NaN: it is a limit from above
  std::size_t points = 0;                 ///< that could show it; 0 of a finding's depth
  std::vector<std::string> lacking = {};  ///< where of these it could not be measured, one each
  SetPoint at = {};                       ///< the points it holds at; any: all together
};

/// Circumstances of a run; of a stored recording only `software` and `started_utc` are known.
struct RunFacts {
  std::string serial;
  std::string started_utc;
  std::string judged_utc = {};  ///< when its verdict was known; empty: by an older rvbench
  std::string plan;
  std::string limits_version = {};  ///< in place of the plan's own limits; empty: those
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
  std::string not_this_machine;  ///< why demand_confirmation() refuses the data; not in files
  analysis::Diagnosis diagnosis;
  std::vector<LimitCheck> limits;
  std::vector<JudgedPoint> points;
  std::vector<std::string> unwritten;  ///< result files that are missing, and why; not in them
};

}  // namespace rvbench::bench
