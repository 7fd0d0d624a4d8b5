#include "sequences/bench_devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/units.hpp"

namespace rvbench::sequences {
namespace {

constexpr double angles_kept_s = 0.3;
constexpr double ahead_at_most_s = 0.05;  // of a sample clock: time stamps are no better than that
constexpr double fresh_within_s = 0.25;   // for telling standstill: the drive is polled every 50 ms

double backoff_s(int failures) { return std::min(0.5, 0.01 * std::pow(2.0, failures)); }

}  // namespace

BenchDevices::BenchDevices(hal::Rig& rig) : rig_(rig) {
  // Never seen yet: nothing counts as fresh before its first answer.
  for (const auto watch : watches) (this->*watch).seen_s = -1e9;
}

void BenchDevices::start() {
  started_s_ = rig_.clock->now_s();
  for (const auto watch : watches) (this->*watch).seen_s = started_s_;
}

bool BenchDevices::all_answered() const {
  return std::ranges::all_of(
      watches, [this](const auto watch) { return (this->*watch).seen_s > started_s_; });
}

template <typename T>
std::optional<T> BenchDevices::ask(Watch& watch, const std::function<Result<T>()>& call) {
  if (rig_.clock->now_s() < watch.due_s - 1e-6) return std::nullopt;
  Result<T> answer = call();
  const double now_s = rig_.clock->now_s();
  if (!answer) {
    watch.error = describe(answer.error());
    watch.due_s = now_s + backoff_s(++watch.failures);
    return std::nullopt;
  }
  watch.failures = 0;
  watch.error.clear();
  watch.seen_s = now_s;
  watch.due_s = now_s + watch.period_s;
  return std::move(answer).value();
}

void BenchDevices::read() {
  fresh_ = {};
  fresh_.torque_rate_Hz = rig_.torque_sensor->rate_Hz();
  fresh_.acceleration_rate_Hz = rig_.accelerometers->rate_Hz();
  // The slow ones first: what interlocks act on is then as new as can be.
  fresh_.drive = ask<hal::DriveStatus>(drive_, [this] { return rig_.drive->read(); });
  fresh_.brake = ask<hal::BrakeStatus>(brake_, [this] { return rig_.brake->read(); });
  read_safety();
  const double torque_seen_s = torque_.seen_s;
  const double accelerations_seen_s = accelerations_.seen_s;
  auto torque = ask<hal::TorqueBlock>(torque_, [this] { return rig_.torque_sensor->read(); });
  auto accelerations =
      ask<hal::AccelerationBlock>(accelerations_, [this] { return rig_.accelerometers->read(); });
  torque_.seen_s = torque_seen_s;
  accelerations_.seen_s = accelerations_seen_s;
  if (torque) take_torque(std::move(*torque));
  if (accelerations) take_accelerations(std::move(*accelerations));
  if (fresh_.drive) values_.drive = *fresh_.drive;
  if (fresh_.brake) values_.brake = *fresh_.brake;
  if (fresh_.safety) values_.safety = *fresh_.safety;
}

// A temperature that is not known would switch its interlock off: the sensor is lost. Only in
// virtual time, where nothing can get hot, may it never have been known: recordings hold none.
void BenchDevices::read_safety() {
  const double seen_s = safety_.seen_s;
  fresh_.safety = ask<hal::SafetyStatus>(safety_, [this] { return rig_.safety->read(); });
  if (!fresh_.safety) return;
  const bool is_known = std::isfinite(fresh_.safety->housing_temp_degC);
  temperature_was_known_ = temperature_was_known_ || is_known;
  if (is_known || (!temperature_was_known_ && rig_.clock->is_virtual())) return;
  safety_.seen_s = seen_s;
  safety_.error = "the housing temperature is not known";
}

void BenchDevices::take_torque(hal::TorqueBlock block) {
  const double end_s = block.t0_s + double(block.samples.size()) / fresh_.torque_rate_Hz;
  double sum_Nm = 0;
  int known = 0;
  AnglePoint last{not_known, not_known};
  for (std::size_t i = 0; i < block.samples.size(); ++i) {
    const hal::TorqueSample& sample = block.samples[i];
    if (!std::isfinite(sample.torque_Nm) || !std::isfinite(sample.angle_rad)) continue;
    sum_Nm += sample.torque_Nm;
    ++known;
    last = {block.t0_s + double(i) / fresh_.torque_rate_Hz, sample.angle_rad};
  }
  if (block.samples.empty() || !(end_s > torque_end_s_)) {
    torque_.error = "its samples do not go on";
    return;
  }
  torque_end_s_ = end_s;
  fresh_.torque = std::move(block);  // lost samples, too: the record has a place for each
  if (known == 0) {
    torque_.error = "its samples are lost";
    return;
  }
  torque_.seen_s = std::min(end_s, rig_.clock->now_s());
  angles_.push_back(last);
  while (angles_.front().time_s < last.time_s - angles_kept_s) angles_.pop_front();
  values_.angle_s = last.time_s;
  values_.angle_rad = last.angle_rad;
  values_.torque_Nm = sum_Nm / known;
  if (angles_.size() > 1) {
    const AnglePoint& before = angles_[angles_.size() - 2];
    fresh_.speed_rpm =
        units::rpm_from_rad_s((last.angle_rad - before.angle_rad) / (last.time_s - before.time_s));
  }
}

void BenchDevices::take_accelerations(hal::AccelerationBlock block) {
  const double end_s = block.t0_s + double(block.scans.rows()) / fresh_.acceleration_rate_Hz;
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
  fresh_.accelerations = std::move(block);  // lost scans, too: the record has a place for each
}

void BenchDevices::write(double speed_rpm, double brake_torque_Nm) {
  ask<Done>(drive_command_, [&] { return rig_.drive->set_speed(speed_rpm); });
  hold_brake(brake_torque_Nm);
}

void BenchDevices::hold_brake(double torque_Nm) {
  ask<Done>(brake_command_, [&] { return rig_.brake->set_torque(torque_Nm); });
}

void BenchDevices::leave_drive_alone(double until_s) { drive_.due_s = until_s; }

void BenchDevices::end_speed_commands() {
  drive_command_.seen_s = std::numeric_limits<double>::infinity();
}

std::string BenchDevices::lost(double stale_after_s) const {
  std::string all;
  for (const auto member : watches) {
    const Watch& watch = this->*member;
    const double age_s = rig_.clock->now_s() - watch.seen_s;
    if (age_s <= stale_after_s + 1e-6) continue;
    all += fmt::format("{}{} silent for {:.2f} s{}", all.empty() ? "" : "; ", watch.device, age_s,
                       watch.error.empty() ? "" : " (" + watch.error + ")");
  }
  return all;
}

double BenchDevices::measured_speed_rpm(double window_s) const {
  if (angles_.empty() || rig_.clock->now_s() - torque_.seen_s > fresh_within_s) return not_known;
  const AnglePoint& last = angles_.back();
  for (auto point = angles_.rbegin(); point != angles_.rend(); ++point) {
    const double length_s = last.time_s - point->time_s;
    if (length_s >= window_s - 1e-6) {
      return units::rpm_from_rad_s((last.angle_rad - point->angle_rad) / length_s);
    }
  }
  return not_known;
}

bool BenchDevices::drive_is_fresh() const {
  return rig_.clock->now_s() - drive_.seen_s <= fresh_within_s;
}

}  // namespace rvbench::sequences
