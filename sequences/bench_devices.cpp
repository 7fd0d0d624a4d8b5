#include "sequences/bench_devices.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::sequences {
namespace {

constexpr double longest_stop_s = 2;  // no drive's deadline is longer

// For telling standstill.
constexpr double fresh_within_s = 0.25;       // the drive is polled every 50 ms
constexpr double standstill_window_s = 0.05;  // 5 rpm are 1.5 degrees: any encoder sees them

}  // namespace

void BenchDevices::start() {
  started_s_ = rig_.clock->now_s();
  drive_.status.seen_s = drive_.command.seen_s = started_s_;
  drive_.fresh.reset();
  supervisor_.start(drive_);
}

bool BenchDevices::all_answered() const {
  return taken_.all_answered && drive_.status.seen_s > started_s_ &&
         drive_.command.seen_s > started_s_;
}

// The drive first, it takes its time: what interlocks act on is then as new as can be.
void BenchDevices::read() {
  drive_.fresh.reset();
  if (!supervisor_.is_stopping_drive()) {
    drive_.fresh =
        drive_.status.ask<hal::DriveStatus>(*rig_.clock, [this] { return rig_.drive->read(); });
  }
  taken_ = supervisor_.exchange(drive_);
  FreshValues& fresh = taken_.fresh;
  fresh.drive = drive_.fresh;
  if (fresh.drive) values_.drive = *fresh.drive;
  if (fresh.brake) values_.brake = *fresh.brake;
  if (fresh.safety) values_.safety = *fresh.safety;
  if (std::isfinite(fresh.angle_s)) {
    angles_.add(fresh.angle_s, fresh.angle_rad);
    values_.angle_s = fresh.angle_s;
    values_.angle_rad = fresh.angle_rad;
    values_.torque_Nm = fresh.torque_mean_Nm;
  }
  if (fresh.drive) fastest_since_heard_rpm_ = not_known;
  fastest_since_heard_rpm_ =
      std::fmax(fastest_since_heard_rpm_, std::abs(measured_speed_rpm(standstill_window_s)));
}

// The supervisor may stop the drive at any moment: its stop has the last word.
void BenchDevices::write(double speed_rpm, double brake_torque_Nm) {
  if (supervisor_.is_tripped()) return;
  drive_.command.ask<Done>(*rig_.clock, [&] { return rig_.drive->set_speed(speed_rpm); });
  supervisor_.hear_sequencer();
  if (supervisor_.is_tripped()) stop_after_supervisor();
  hold_brake(brake_torque_Nm);
}

void BenchDevices::hold_brake(double torque_Nm) { supervisor_.hold_brake(torque_Nm); }

// One that hangs is not waited for. In virtual time no stop is under way here.
void BenchDevices::stop_after_supervisor() noexcept {
  const double until_s = rig_.clock->now_s() + longest_stop_s;
  while (supervisor_.is_stopping_drive() && rig_.clock->now_s() < until_s) {
    rig_.clock->wait_until(rig_.clock->now_s() + 0.001);
  }
  stop_drive();
}

// A stop that hangs holds whatever this one would wait for: the drive's own watchdog is left.
void BenchDevices::stop_drive() noexcept {
  if (supervisor_.is_stopping_drive()) return;
  rig_.drive->stop();
  supervisor_.hear_sequencer();  // a drive may take its time, one call after the other
}

void BenchDevices::leave_drive_alone(double until_s) { drive_.status.due_s = until_s; }

void BenchDevices::end_speed_commands() { drive_.command.seen_s = DeviceWatch::always_seen_s; }

double BenchDevices::measured_speed_rpm(double window_s) const {
  if (angles_.is_empty() || rig_.clock->now_s() - angles_.newest_s() > fresh_within_s) {
    return not_known;
  }
  return angles_.speed_rpm(window_s);
}

bool BenchDevices::drive_is_fresh() const {
  return rig_.clock->now_s() - drive_.status.seen_s <= fresh_within_s;
}

bool BenchDevices::drive_fell_silent() const {
  const double heard_s = std::min(drive_.status.seen_s, drive_.command.seen_s);
  return heard_s > DeviceWatch::never_seen_s && rig_.clock->now_s() - heard_s > fresh_within_s;
}

bool BenchDevices::stands_still(double limit_rpm) const {
  const double measured_rpm = std::abs(measured_speed_rpm(standstill_window_s));
  const hal::DriveStatus& drive = values_.drive;
  const bool drive_knows = drive_is_fresh() && std::isfinite(drive.speed_rpm);
  const bool drive_stopped = std::abs(drive.speed_rpm) <= limit_rpm;
  if (!std::isfinite(measured_rpm)) return drive_knows && drive_stopped;
  if (measured_rpm > limit_rpm) return false;
  return drive_knows ? !drive.running || drive_stopped : !was_contradicted(limit_rpm);
}

// An angle that has moved since then is alive: it only lagged behind. All comparisons are false for
// what is not known.
bool BenchDevices::was_contradicted(double limit_rpm) const {
  return values_.drive.running && std::abs(values_.drive.speed_rpm) > limit_rpm &&
         fastest_since_heard_rpm_ <= limit_rpm;
}

}  // namespace rvbench::sequences
