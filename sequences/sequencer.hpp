#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "hal/recording_file.hpp"
#include "hal/rig.hpp"
#include "hal/types/outcome.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// What the sequencer tells while it works: progress bar, log, live page.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// @param done_s, total_s  of the rig's own time, by the plan's timeline
  virtual void progress(double done_s, double total_s, const std::string& doing) = 0;
  virtual void event(double time_s, const std::string& text) = 0;
};

/// What the run left behind, besides the recording.
struct RunSummary {
  Ending ending;  ///< PASS here means only: everything was measured; the judge has the last word
  std::vector<hal::PointResult> points;
  int drive_retries = 0;
  bool shaft_stopped = false;  ///< standstill was seen on a measured value
  bool brake_released = false;
  double duration_s = 0;  ///< of the rig's time
};

/// Setup → main → teardown. Never throws: whatever happens inside ends in teardown, with the
/// shaft stopped and the brake released, and in an Ending that says why.
///
/// @param first_point  points before it are skipped (a resumed run); warm-up is done again
/// @param stop         requested by Ctrl-C: ends ABORTED at the next tick
RunSummary run_sequence(const TestPlan& plan, hal::Rig& rig, hal::RecordingWriter& recording,
                        RunObserver& observer, std::stop_token stop, int first_point = 0);

}  // namespace rvbench::sequences
