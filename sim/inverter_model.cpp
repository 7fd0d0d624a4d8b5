#include "sim/inverter_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "hal/types/require_positive.hpp"

namespace rvbench::sim {
namespace {

InverterParameters checked(const InverterParameters& p) {
  require_positive(p.pole_pairs, "InverterModel", "pole_pairs");
  require_positive(p.max_frequency_Hz, "InverterModel", "max_frequency_Hz");
  require_positive(p.ramp_up_Hz_per_s, "InverterModel", "ramp_up_Hz_per_s");
  require_positive(p.ramp_down_Hz_per_s, "InverterModel", "ramp_down_Hz_per_s");
  if (p.comm_loss_timeout_s != 0)
    require_positive(p.comm_loss_timeout_s, "InverterModel", "comm_loss_timeout_s");
  return p;
}

double signed_setpoint_Hz(const InverterState& state) {
  if (state.run == RunCommand::forward) return state.setpoint_Hz;
  if (state.run == RunCommand::reverse) return -state.setpoint_Hz;
  return 0;
}

}  // namespace

InverterModel::InverterModel(const InverterParameters& parameters)
    : parameters_(checked(parameters)) {}

void InverterModel::advance(double dt_s) {
  if (!std::isfinite(dt_s) || dt_s < 0) {
    throw std::invalid_argument("InverterModel::advance: dt_s is " + std::to_string(dt_s) +
                                ", must be finite and not negative");
  }
  const std::lock_guard lock(mutex_);
  time_s_ += dt_s;
  silence_s_ += dt_s;
  const bool watched = parameters_.comm_loss_timeout_s > 0 && state_.output_enabled &&
                       !state_.local && !state_.tripped &&
                       parameters_.comm_loss_action != CommLossAction::ignore;
  if (watched && silence_s_ > parameters_.comm_loss_timeout_s) {
    trip_locked(fault_comm_loss, parameters_.comm_loss_action == CommLossAction::ramp_to_stop);
  }
  ramp_locked(dt_s);
}

void InverterModel::set_measured(double speed_rpm, double current_A) {
  const std::lock_guard lock(mutex_);
  state_.speed_rpm = speed_rpm;
  state_.current_A = current_A;
}

double InverterModel::output_frequency_Hz() const { return state().output_frequency_Hz; }

bool InverterModel::output_enabled() const { return state().output_enabled; }

InverterState InverterModel::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

double InverterModel::time_s() const {
  const std::lock_guard lock(mutex_);
  return time_s_;
}

void InverterModel::trip(int fault_code) {
  const std::lock_guard lock(mutex_);
  trip_locked(fault_code, false);
}

void InverterModel::note_request() {
  const std::lock_guard lock(mutex_);
  silence_s_ = 0;
}

bool InverterModel::command(RunCommand run, double setpoint_Hz) {
  const std::lock_guard lock(mutex_);
  if (!(setpoint_Hz >= 0 && setpoint_Hz <= parameters_.max_frequency_Hz)) return false;
  if (run != RunCommand::stop && state_.tripped) return false;
  if (!state_.local) follow_locked(run, setpoint_Hz);
  return true;
}

void InverterModel::take_over(RunCommand run, double setpoint_Hz) {
  const std::lock_guard lock(mutex_);
  state_.local = true;
  follow_locked(run, setpoint_Hz);
}

void InverterModel::give_back() {
  const std::lock_guard lock(mutex_);
  follow_locked(RunCommand::stop, 0);
  state_.local = false;
}

void InverterModel::set_reset(bool level) {
  const std::lock_guard lock(mutex_);
  const bool rising = level && !reset_level_;
  reset_level_ = level;
  if (!rising || state_.run != RunCommand::stop) return;
  state_.tripped = false;
  state_.fault_code = 0;
}

void InverterModel::follow_locked(RunCommand run, double setpoint_Hz) {
  state_.run = run;
  state_.setpoint_Hz = setpoint_Hz;
  if (run != RunCommand::stop) state_.output_enabled = true;
}

void InverterModel::trip_locked(int fault_code, bool ramp_down) {
  state_.tripped = true;
  state_.fault_code = fault_code;
  state_.run = RunCommand::stop;
  state_.setpoint_Hz = 0;
  if (ramp_down) return;
  state_.output_enabled = false;
  state_.output_frequency_Hz = 0;
}

void InverterModel::ramp_locked(double dt_s) {
  const double now_Hz = state_.output_frequency_Hz;
  double target_Hz = signed_setpoint_Hz(state_);
  if (target_Hz * now_Hz < 0) target_Hz = 0;  // a reversal passes through standstill
  const bool rises = std::abs(target_Hz) > std::abs(now_Hz);
  const double step_Hz =
      dt_s * (rises ? parameters_.ramp_up_Hz_per_s : parameters_.ramp_down_Hz_per_s);
  state_.output_frequency_Hz = now_Hz + std::clamp(target_Hz - now_Hz, -step_Hz, step_Hz);
  if (state_.run == RunCommand::stop && state_.output_frequency_Hz == 0) {
    state_.output_enabled = false;
  }
}

}  // namespace rvbench::sim
