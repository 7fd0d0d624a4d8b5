#pragma once

#include <optional>

namespace rvbench::sequences {

/// What the bench may do. Nothing turns before ARMED.
enum class SupervisorState {
  faulted,  ///< at power-on, and after every trip: only a reset leads out
  ready,    ///< every device answers afresh, nothing is commanded
  armed,    ///< the drive's watchdog is on: commands may come
  running,  ///< a speed is commanded
  stopping  ///< the shaft runs down
};

enum class SupervisorEvent {
  reset,       ///< an edge: all devices well, seen afresh, setpoints zero, shaft at rest
  arm,         ///< the drive's watchdog was read back and will stop the motor
  run,         ///< a speed other than 0 is commanded
  stop,        ///< the run is over, or is ended
  standstill,  ///< measured
  trip         ///< an interlock, a lost device, an abort: from any state
};

inline constexpr int supervisor_states = 5;
inline constexpr int supervisor_events = 6;

/// The state that an event leads to; nothing where it may not happen. The whole machine is this
/// table: nobody resumes by himself, for no event but reset leads out of FAULTED.
std::optional<SupervisorState> next_state(SupervisorState state, SupervisorEvent event) noexcept;

const char* to_string(SupervisorState state) noexcept;  ///< "FAULTED", "READY", ...
const char* to_string(SupervisorEvent event) noexcept;  ///< "reset", "arm", ...

}  // namespace rvbench::sequences
