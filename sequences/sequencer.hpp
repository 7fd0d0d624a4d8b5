#pragma once

#include <cstddef>
#include <set>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "hal/recording_file.hpp"
#include "hal/rig.hpp"
#include "hal/types/outcome.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {

/// What the sequencer tells while it works: progress bar, log, live page.
///
/// Threads  in real time progress() comes from one thread and event() from another, so that a
///          screen that hangs leaves the log alone; each of them one call at a time
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
  /// A device's call has never returned. Its thread goes on: the rig must not be used any more, nor
  /// destroyed, and the process has to exit without doing so. See Supervisor.
  bool supervisor_hung = false;
  /// A bus has not told its counters, a second after the end. As with supervisor_hung, the rig must
  /// not be destroyed, and the process has to exit.
  bool bus_hung = false;
  /// A call of the observer has not returned either, a second after the end: it goes on in a thread
  /// of its own, so that the observer must neither be told more in that way nor be destroyed.
  bool observer_hung = false;
  /// to the observer, whose log was too far behind or hangs: a run whose log has a hole is an ERROR
  std::size_t events_untold = 0;
};

/// What the events of a run tell of its last part: that it ended with the shaft at standstill, the
/// brake released and nothing wrong with the bench. False if they do not tell, as after a kill.
bool tell_of_rest(const std::vector<std::pair<double, std::string>>& events);

/// The points that the events of a run tell as ended.
std::set<int> points_told(const std::vector<std::pair<double, std::string>>& events);

/// Setup → main → teardown. Never throws: whatever happens inside ends in teardown, with the
/// shaft stopped and the brake released, and in an Ending that says why.
///
/// A supervisor that hangs in a device's call holds up neither the stop nor the end: the drive is
/// the sequencer's own and is told to stop; brake and accelerometers are left alone, for the call
/// that hangs may hold whatever theirs would wait for. Their own watchdogs release the brake.
///
/// @param first_point  points before it are skipped (a resumed run); warm-up is done again
/// @param stop         requested by Ctrl-C: ends ABORTED at the next tick
RunSummary run_sequence(const TestPlan& plan, hal::Rig& rig, hal::RecordingWriter& recording,
                        RunObserver& observer, std::stop_token stop, int first_point = 0);

}  // namespace rvbench::sequences
