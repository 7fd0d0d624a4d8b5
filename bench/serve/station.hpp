#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/qualification/qualification.hpp"
#include "bench/serve/event_hub.hpp"
#include "bench/serve/known_runs.hpp"
#include "bench/serve/live_socket.hpp"
#include "bench/serve/other_process.hpp"
#include "bench/serve/station_file.hpp"
#include "hal/recording_file.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// Whom the station speaks to.
struct StationViewer {
  Role role = Role::viewer;
  bool is_remote = false;  ///< at another computer
};

/// What stands at a station: which unit was scanned, how its run goes, what came of it. Of the run
/// itself it knows what the run's process tells; that process goes on without it, and a station
/// that is made anew finds it again.
///
/// Order    tick() about ten times a second, from one thread, at the priority that runs are to have
/// Threads  the other calls may come from any
class Station {
 public:
  /// @throws std::system_error: no folder for runs or for what the station keeps
  Station(StationFile file, std::filesystem::path program, EventHub& hub);

  // Each returns "", or the word of the API for why not.
  std::string scan(const std::string& text);  ///< "running", "empty", "serial_rule",
                                              ///< "check_digit", "almost_golden"
  /// "running", "no_unit", "duplicate", "not_qualified", "remote_start_off", "other_unit": somebody
  /// else has scanned another one meanwhile
  std::string start(const std::string& serial, bool is_retest, const StationViewer& viewer);
  std::string may_start(bool is_retest, const StationViewer& viewer) const;  ///< what it would say
  std::string stop();                                                        ///< "not_running"
  std::string clear();                                                       ///< "running"

  std::string state(const StationViewer& viewer) const;  ///< JSON, in one line
  std::string serial() const;
  bool is_running() const;
  void tick();

  const StationFile& file() const { return file_; }

 private:
  enum class Phase { idle, ready, duplicate, running, ended };
  struct Progress {
    std::string stage, text;
    double done = 0, left_s = not_known;
  };

  void read_plan();
  void gather();  // these two without the lock, all others with it
  void look_after_qualification(bool has_ended);
  void hold_against_time();
  void forget_unit();
  void forget_run();
  std::filesystem::path live_file() const { return keep_ / "live.sock"; }
  void find_run();
  void keep_unit() const;
  void spawn();
  void hear();
  void hear(const nlohmann::json& letter);
  void conclude();
  /// @param code  what the page has a sentence for
  void fail(const std::string& code, const std::string& reason, Outcome outcome = Outcome::error);
  void fail_before_it_began();
  void tell_change();
  std::string why_not(bool is_retest, const StationViewer& viewer) const;
  std::string next_action(const StationViewer& viewer) const;
  std::string newest_run() const;
  static const char* to_string(Phase phase);

  const StationFile file_;
  const std::filesystem::path program_, keep_;
  EventHub& hub_;
  RunProcess process_;
  LiveSocket live_;

  mutable std::mutex mutex_;
  Phase phase_ = Phase::idle;
  bool is_due_ = false;  // to be started by tick()
  bool is_told_to_stop_ = false;
  std::string serial_;
  std::vector<KnownRun> known_;
  std::vector<std::string> faults_;   // of plan and rig
  std::optional<RigFile> rig_;        // none where it has faults
  StationEvidence evidence_;          // of what the rig asks of the station
  std::vector<std::string> reasons_;  // why it is not qualified
  std::vector<hal::PlannedPoint> points_;
  std::string point_states_;
  Progress progress_;
  std::string run_;
  std::string verdict_ = "null";  // JSON
  std::string told_;              // what was told last

  // Of tick() alone: when it looked last, and what the records' folder was like then.
  std::chrono::steady_clock::time_point judged_, gathered_;
  std::filesystem::file_time_type records_changed_;
};

}  // namespace rvbench::bench
