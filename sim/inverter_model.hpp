#pragma once

#include <mutex>

namespace rvbench::sim {

/// What the simulated drive does by itself when requests stop coming while its output is on.
enum class CommLossAction { ignore, ramp_to_stop, coast };

/// As the settings of a general-purpose inverter allow; the ramps are assumed.
struct InverterParameters {
  int pole_pairs = 2;
  double max_frequency_Hz = 120;
  double ramp_up_Hz_per_s = 20;
  double ramp_down_Hz_per_s = 20;
  double comm_loss_timeout_s = 1.0;  ///< 0 = watchdog off
  CommLossAction comm_loss_action = CommLossAction::ramp_to_stop;
};

enum class RunCommand { stop, forward, reverse };

/// Fault codes of the simulated drive; 0 is none.
inline constexpr int fault_comm_loss = 1;
inline constexpr int fault_overcurrent = 2;

struct InverterState {
  RunCommand run = RunCommand::stop;
  double setpoint_Hz = 0;          ///< magnitude
  double output_frequency_Hz = 0;  ///< signed: negative turns backwards
  bool output_enabled = false;     ///< false: the motor coasts
  bool tripped = false;
  bool local = false;  ///< it obeys its panel
  int fault_code = 0;
  double speed_rpm = 0;  ///< as told by set_measured()
  double current_A = 0;
};

/// The inside of an inverter: run word, ramps, communication watchdog, trip and reset.
///
/// Time     purely virtual: it moves only in advance()
/// Faults   a trip zeroes run word and setpoint; nothing resumes by itself: reset is an edge, and
///          a new run command must follow it
/// Threads  all calls may overlap: the plant advances it while a server thread serves requests
class InverterModel {
 public:
  /// @throws std::invalid_argument if a parameter is not finite, not positive (the time-out may
  ///         be 0), or pole_pairs < 1
  explicit InverterModel(const InverterParameters& parameters = {});

  const InverterParameters& parameters() const { return parameters_; }

  // The plant's side.
  void advance(double dt_s);  ///< @throws std::invalid_argument if dt_s < 0 or not finite
  void set_measured(double speed_rpm, double current_A);
  double output_frequency_Hz() const;
  bool output_enabled() const;
  InverterState state() const;
  double time_s() const;  ///< the sum of all dt_s
  /// Somebody at the panel takes the drive over, and turns the motor as they like; requests are
  /// answered, commands are not followed. Giving it back leaves it stopped.
  void take_over(RunCommand run, double setpoint_Hz);
  void give_back();
  void trip(int fault_code);  ///< switches the output off at once; the motor coasts

  // The wire's side.
  void note_request();  ///< feeds the watchdog: call it for each valid request

  /// Takes a run word and a frequency magnitude. False, and nothing changes, if the setpoint is
  /// negative or above max_frequency_Hz, or if a run is asked for while tripped.
  bool command(RunCommand run, double setpoint_Hz);

  /// The reset input: a trip is cleared on its rising edge, with the run word at stop.
  void set_reset(bool level);

 private:
  void follow_locked(RunCommand run, double setpoint_Hz);
  void trip_locked(int fault_code, bool ramp_down);
  void ramp_locked(double dt_s);

  const InverterParameters parameters_;
  mutable std::mutex mutex_;
  bool reset_level_ = false;
  double silence_s_ = 0;
  double time_s_ = 0;
  InverterState state_;
};

}  // namespace rvbench::sim
