#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "hal/rig.hpp"
#include "sequences/bench_devices.hpp"
#include "sequences/bus_watch.hpp"
#include "sequences/plan.hpp"
#include "sequences/point_recorder.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::sequences {

/// How waiting for something went.
struct Waited {
  std::optional<Ending> ending;  ///< the run must end like this
  bool met = false;              ///< else: true if it came, false at the time-out
};

/// Torque at the output shaft for a load in percent of the rated one.
double load_torque_Nm(const Specimen& specimen, double load_pct);

inline constexpr const char* armed_event = "armed";         ///< from here on the shaft may turn
inline constexpr const char* point_event = "point {}: {}";  ///< it has ended; number and status

/// The one loop of a run: phases say what to do and for how long, and every 10 ms of the rig's
/// time it asks the drive, takes over what the supervisor has read and found, feeds the devices'
/// watchdogs, and hands samples to the recording.
///
/// An ending is final: the drive is stopped before anything else, and from then on every wait
/// returns that ending at once. Nothing resumes by itself.
class BenchLoop {
 public:
  BenchLoop(const TestPlan& plan, hal::Rig& rig, hal::RecordingWriter& recording,
            RunObserver& observer, std::stop_token stop, int first_point);

  /// Begins to watch the devices, which are connected by now, and waits until each has answered
  /// and the shaft stands still; ends at once on E-stop or guard.
  std::optional<Ending> arm();

  /// Written at the next tick. @throws std::logic_error before arm(), if the shaft is to turn
  void command(double speed_rpm, double brake_torque_Nm);
  std::optional<Ending> run_for(double duration_s);
  Waited run_until(const std::function<bool(const BenchValues&)>& met, double timeout_s);

  /// The number of the next point of the plan; nothing if an earlier run has recorded it.
  std::optional<int> next_point();
  /// Records until the input shaft has made so many turns; "too_short" at the time-out,
  /// "bus_errors" if a counter of a bus has moved meanwhile. It ends once every hole in it would
  /// have been told: Accelerometers::hole_told_after_s().
  std::optional<Ending> record_point(int point, double input_turns, double timeout_s);
  /// Records while `work` lasts, and ends as record_point() does. The shaft may turn either way: no
  /// load tells what its torque must be.
  /// @param unmet  the record's status where the work did not come to its end
  std::optional<Ending> record_work(int point, const char* unmet,
                                    const std::function<Waited()>& work);
  /// Ends the record that an exception left open, if any.
  void interrupt_record();
  /// Ends a point that was not recorded.
  std::optional<Ending> give_up_point(const hal::PointResult& result);

  void enter(const Segment& segment);  ///< for progress
  void event(const std::string& text);
  double now_s() const { return rig_.clock->now_s(); }
  hal::Rig& rig() { return rig_; }
  Supervisor& supervisor() { return supervisor_; }
  BenchDevices& devices() { return devices_; }
  bool end_buses() noexcept { return buses_.finish(); }        ///< false if one hangs: see BusWatch
  double brake_torque_Nm() const { return brake_torque_Nm_; }  ///< as commanded
  bool has_turned() const { return has_turned_; }              ///< a speed was ever commanded
  /// Empty while the run goes on.
  std::optional<Ending> ended() const { return supervisor_.latched(); }
  const std::vector<hal::PointResult>& points() const { return points_; }

 private:
  std::optional<Ending> tick();
  std::optional<Ending> trouble();
  std::optional<Ending> record(int point, const char* unmet, const std::function<Waited()>& work,
                               const std::function<double()>& least_Nm);
  Ending await_trip();
  std::optional<Ending> await_buses();
  std::optional<Ending> await_sound_end();
  double planned_s(const Segment& segment) const;
  double least_torque_Nm() const;
  bool speeds_disagree();
  Ending end(const Ending& ending);
  void report_progress();

  const TestPlan& plan_;
  hal::Rig& rig_;
  hal::RecordingWriter& recording_;
  RunObserver& observer_;
  std::stop_token stop_;
  int first_point_;

  Supervisor supervisor_;
  BenchDevices devices_;
  PointRecorder recorder_;
  BusWatch buses_;
  double speed_rpm_ = 0;
  bool has_turned_ = false;
  double brake_torque_Nm_ = 0;
  double next_tick_s_ = 0;
  double next_write_s_ = 0;
  double agreed_s_ = 0;

  int next_point_ = 0;
  std::vector<hal::PointResult> points_;

  Segment segment_;
  double segment_start_s_ = 0;
  double done_s_ = 0;
  double total_s_ = 0;
  double next_report_s_ = 0;
};

}  // namespace rvbench::sequences
