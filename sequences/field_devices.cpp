#include "sequences/field_devices.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::sequences {
namespace {

constexpr double ahead_at_most_s = 0.05;   // of a sample clock: time stamps are no better than that
constexpr double speed_window_s = 0.0099;  // shorter ones tell the steps of the encoder

// A value that a device has held for a while is as old as it says, not as its reading.
double seen_when(double time_s, double read_s) {
  return std::isfinite(time_s) ? std::min(time_s, read_s) : read_s;
}

}  // namespace

void FieldDevices::start() {
  started_s_ = rig_.clock->now_s();
  for (const auto watch : watches) (this->*watch).seen_s = started_s_;
}

bool FieldDevices::all_answered() const {
  return std::ranges::all_of(
      watches, [this](const auto watch) { return (this->*watch).seen_s > started_s_; });
}

FreshValues FieldDevices::read() {
  FreshValues fresh;
  fresh.torque_rate_Hz = rig_.torque_sensor->rate_Hz();
  fresh.acceleration_rate_Hz = rig_.accelerometers->rate_Hz();
  // The slow one first: what interlocks act on is then as new as can be.
  fresh.brake = brake_.ask<hal::BrakeStatus>(*rig_.clock, [this] { return rig_.brake->read(); });
  if (fresh.brake) brake_.seen_s = seen_when(fresh.brake->time_s, brake_.seen_s);
  read_safety(fresh);
  read_torque(fresh);
  read_accelerations(fresh);
  return fresh;
}

// A temperature that is not known would switch its interlock off: the sensor is lost. Only in
// virtual time, where nothing can get hot, may it never have been known: recordings hold none.
void FieldDevices::read_safety(FreshValues& fresh) {
  const double seen_s = safety_.seen_s;
  fresh.safety =
      safety_.ask<hal::SafetyStatus>(*rig_.clock, [this] { return rig_.safety->read(); });
  if (!fresh.safety) return;
  safety_.seen_s = seen_when(fresh.safety->time_s, safety_.seen_s);
  const bool is_known = std::isfinite(fresh.safety->housing_temp_degC);
  temperature_was_known_ = temperature_was_known_ || is_known;
  const bool can_get_hot = !rig_.clock->is_virtual() && !rig_.is_played;
  if (is_known || (!temperature_was_known_ && !can_get_hot)) return;
  safety_.seen_s = seen_s;
  safety_.error = "the housing temperature is not known";
}

void FieldDevices::read_torque(FreshValues& fresh) {
  const double seen_s = torque_.seen_s;
  auto block =
      torque_.ask<hal::TorqueBlock>(*rig_.clock, [this] { return rig_.torque_sensor->read(); });
  torque_.seen_s = seen_s;  // an answer without news is none
  if (block) take_torque(std::move(*block), fresh);
}

void FieldDevices::read_accelerations(FreshValues& fresh) {
  const double seen_s = accelerations_.seen_s;
  auto block = accelerations_.ask<hal::AccelerationBlock>(
      *rig_.clock, [this] { return rig_.accelerometers->read(); });
  accelerations_.seen_s = seen_s;
  if (block) take_accelerations(std::move(*block), fresh);
}

void FieldDevices::take_torque(hal::TorqueBlock block, FreshValues& fresh) {
  const double end_s = block.t0_s + double(block.samples.size()) / fresh.torque_rate_Hz;
  double sum_Nm = 0, angle_s = not_known, angle_rad = not_known;
  int known = 0;
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    const hal::TorqueSample& sample = block.samples[i];
    if (!std::isfinite(sample.torque_Nm) || !std::isfinite(sample.angle_rad)) continue;
    sum_Nm += sample.torque_Nm;
    ++known;
    angle_s = block.t0_s + double(i) / fresh.torque_rate_Hz;
    angle_rad = sample.angle_rad;
  }
  if (block.samples.empty() || !(end_s > torque_end_s_)) {
    torque_.error = "its samples do not go on";
    return;
  }
  torque_end_s_ = end_s;
  fresh.torque = std::move(block);  // lost samples, too: the record has a place for each
  if (known == 0) {
    torque_.error = "its samples are lost";
    return;
  }
  torque_.seen_s = std::min(end_s, rig_.clock->now_s());
  fresh.torque_mean_Nm = sum_Nm / known;
  fresh.angle_s = angle_s;
  fresh.angle_rad = angle_rad;
  angles_.add(angle_s, angle_rad);
  fresh.speed_rpm = angles_.speed_rpm(speed_window_s);
}

void FieldDevices::take_accelerations(hal::AccelerationBlock block, FreshValues& fresh) {
  const double end_s = block.t0_s + double(block.scans.rows()) / fresh.acceleration_rate_Hz;
  if (block.scans.rows() == 0 || !(end_s > accelerations_end_s_)) {
    accelerations_.error = "its samples do not go on";
    return;
  }
  accelerations_end_s_ = end_s;
  if (end_s > rig_.clock->now_s() + ahead_at_most_s) {
    accelerations_.error = "its samples run ahead of the clock";
  } else if (block.lost < block.scans.rows()) {
    accelerations_.seen_s = std::min(end_s, rig_.clock->now_s());
  } else {
    accelerations_.error = "its samples are lost";
  }
  fresh.accelerations = std::move(block);  // lost scans, too: the record has a place for each
}

void FieldDevices::hold_brake(double torque_Nm) {
  brake_command_.ask<Done>(*rig_.clock, [&] { return rig_.brake->set_torque(torque_Nm); });
}

std::string FieldDevices::lost(double stale_after_s) const {
  std::string all;
  for (const auto watch : watches) {
    const std::string one = (this->*watch).lost(rig_.clock->now_s(), stale_after_s);
    if (!one.empty()) all += (all.empty() ? "" : "; ") + one;
  }
  return all;
}

}  // namespace rvbench::sequences
