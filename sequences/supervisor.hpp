#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hal/inheriting_mutex.hpp"
#include "hal/rig.hpp"
#include "hal/service_watchdog.hpp"
#include "hal/types/outcome.hpp"
#include "sequences/device_watch.hpp"
#include "sequences/field_devices.hpp"
#include "sequences/fresh_values.hpp"
#include "sequences/lateness.hpp"
#include "sequences/plan.hpp"
#include "sequences/supervisor_state.hpp"

namespace rvbench::sequences {

/// What the sequencer knows of the drive, which only it may ask.
struct DriveReport {
  std::optional<hal::DriveStatus> fresh;
  DeviceWatch status{"drive", 0.05};
  DeviceWatch command{"drive (speed command)"};
};

/// What the supervisor hands over.
struct Handover {
  FreshValues fresh;
  bool all_answered = false;  ///< the field devices
  std::string lost;           ///< what has been silent for too long, the drive included
};

/// Stands beside the sequencer and looks at nothing but safety: reads the field devices, holds
/// every fresh value against the interlocks and every age against the plan's limit, and at the
/// first trouble stops the drive, before anything else is done. The ending is latched: no later
/// good value takes it back.
///
/// Threads  with a real clock it has a thread of its own from start() to end(), at 1 kHz and under
///          SCHED_FIFO where the system allows that: neither disk nor screen nor the drive's slow
///          answers hold it up, and it never waits for the sequencer. In virtual time, and outside
///          of start() and end(), exchange() does its round in the caller's thread.
///          The field devices are its own meanwhile; the others call from one thread
/// Priority the sequencer's thread is an ordinary one, on purpose: it connects, formats and asks
///          for memory, and under SCHED_FIFO would keep from running whoever the supervisor needs.
///          One that is starved is found by the age of the drive's answers. Locks that both take
///          inherit priority; those within malloc do not, and are held for less than a microsecond
/// Hung     a thread that a device's call never gives back cannot be ended. end() gives it up after
///          longest_end_s; the field devices stay its own for ever, this object and the rig must
///          outlive it, and so the process has to exit without destroying them. Until then, and
///          if it does not, the last line is the drive's own watchdog, and the brake's
/// Service  while its thread turns, systemd's watchdog is fed; of one that hangs it hears no more,
///          nor of a sequencer that has not come for longest_pause_s: a drive may hang in a call
class Supervisor {
 public:
  Supervisor(hal::Rig& rig, const Interlocks& limits);
  ~Supervisor();  ///< as end(); @pre its thread does not hang, or std::terminate()
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  void start(const DriveReport& drive);  ///< from now on everything must be seen

  /// Nothing is watched any more, and its thread is gone. False if it hangs, and always from then
  /// on: see above.
  bool end() noexcept;

  /// Tells about the drive and takes over what came since the last call.
  Handover exchange(const DriveReport& drive);
  void hold_brake(double torque_Nm);  ///< one command to the brake: call it cyclically

  /// Moves the state machine; false where the event may not happen. A trip is for good: from the
  /// moment it falls, not only once the drive is stopped, nothing leads out of FAULTED.
  bool handle(SupervisorEvent event) noexcept;
  SupervisorState state() const { return state_; }

  /// Stops the drive, if nobody has yet, and latches the ending.
  void trip(const Ending& ending);
  bool is_tripped() const { return is_latched_; }  ///< the drive is stopped, or about to be
  /// The stop is under way, and may hang: whoever asks the drive for something now may wait for it.
  bool is_stopping_drive() const { return is_latched_ && !has_stopped_drive_; }
  std::optional<Ending> latched() const;  ///< how the run must end; told once the drive is stopped
  double latched_s() const { return latched_s_; }  ///< when it was found; NaN if it was not

  void hear_sequencer() { heard_s_ = rig_.clock->now_s(); }  ///< it lives; exchange() tells it too

  /// Since its thread came round last; 0 without one.
  double silence_s() const;

  std::string without_priority() const;  ///< why its thread has no real-time priority; "" if it has
  Lateness lateness() const;             ///< of its thread's rounds; @pre end()

  static constexpr double period_s = 0.001;
  static constexpr double longest_end_s = 2;     ///< no device's deadline is longer
  static constexpr double longest_pause_s = 10;  ///< of a sequencer that lives

 private:
  void run(const std::stop_token& stop) noexcept;
  void step();
  bool move(SupervisorEvent event) noexcept;
  void halt() noexcept;
  void fault(const char* what) noexcept;
  void look_for_trouble(const FreshValues& fresh);
  std::string lost() const;
  void hand_over(FreshValues fresh);
  void tell(const DriveReport& drive);
  void tell_priority(std::string without);

  hal::Rig& rig_;
  const Interlocks limits_;
  FieldDevices field_;
  hal::ServiceWatchdog service_;
  Lateness lateness_;

  std::atomic<SupervisorState> state_ = SupervisorState::faulted;
  std::atomic<bool> is_watching_ = false;
  std::atomic<bool> is_latched_ = false;
  std::atomic<bool> has_stopped_drive_ = false;
  std::atomic<double> latched_s_ = not_known;
  std::atomic<bool> has_thread_ = false;
  std::atomic<double> round_s_ = 0;  ///< when its thread came round last
  std::atomic<double> heard_s_ = 0;  ///< when the sequencer came last

  // The supervisor's own: what it was told last, what it could not hand over yet.
  DriveReport drive_;
  std::vector<FreshValues> kept_;

  // Held for moments only; the supervisor's rounds never wait for it.
  mutable hal::InheritingMutex mutex_;
  std::optional<DriveReport> told_drive_;
  std::optional<double> told_brake_Nm_;
  std::vector<FreshValues> ready_;
  bool all_answered_ = false;
  std::string lost_;
  std::optional<Ending> latched_;
  std::string without_priority_;

  std::atomic<bool> is_gone_ = false;  ///< its thread is about to return
  std::jthread thread_;
};

}  // namespace rvbench::sequences
