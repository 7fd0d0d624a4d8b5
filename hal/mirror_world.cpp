#include "hal/mirror_world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/units.hpp"

namespace rvbench::hal {
namespace {

constexpr double brake_watchdog_s = 0.5;  // the brake releases when commands stop coming

}  // namespace

MirrorWorld::MirrorWorld(const MirrorOptions& options, Clock& clock)
    : options_(options), clock_(clock) {}

void MirrorWorld::schedule(MirrorFault fault, double from_s, double until_s) {
  faults_[fault] = {from_s, until_s};
}

bool MirrorWorld::has(MirrorFault fault) const {
  const auto at = faults_.find(fault);
  return at != faults_.end() && clock_.now_s() >= at->second.from_s &&
         clock_.now_s() < at->second.until_s;
}

void MirrorWorld::advance() {
  for (;;) {
    const double next_s = double(samples_made_ + 1) / options_.torque_rate_Hz;
    if (next_s > clock_.now_s()) break;
    step(next_s);
    ++samples_made_;
    const double torque_Nm = speed_rpm_ != 0 ? brake_torque_Nm() / options_.gear_ratio : 0;
    samples_.push_back({has(MirrorFault::over_torque) ? 100 : torque_Nm, angle_rad_});
  }
}

void MirrorWorld::step(double time_s) {
  const double dt_s = time_s - std::exchange(time_s_, time_s);
  if (options_.watchdog.stops_motor && time_s - commanded_s_ > options_.watchdog.timeout_s) {
    target_rpm_ = 0;
  }
  const double way_rpm = target_rpm_ * (1 - options_.slip_pct / 100) - speed_rpm_;
  const double most_rpm = options_.ramp_rpm_s * dt_s;
  speed_rpm_ += std::clamp(way_rpm, -most_rpm, most_rpm);
  double shown_rpm = speed_rpm_;
  if (has(MirrorFault::over_speed)) shown_rpm *= 10;
  if (has(MirrorFault::uneven_speed)) {
    shown_rpm *= 1 + 0.2 * std::sin(units::two_pi * 0.3 * time_s);
  }
  angle_rad_ += units::rad_s_from_rpm(shown_rpm) * dt_s;
  if (time_s - brake_commanded_s_ > brake_watchdog_s) brake_Nm_ = 0;
}

void MirrorWorld::command_speed(double speed_rpm) {
  advance();
  target_rpm_ = speed_rpm;
  commanded_s_ = clock_.now_s();
  speed_commands_.emplace_back(commanded_s_, speed_rpm);
}

void MirrorWorld::command_brake(double torque_Nm) {
  advance();
  brake_Nm_ = torque_Nm;
  brake_commanded_s_ = clock_.now_s();
  brake_released_s_ = not_known;
}

void MirrorWorld::release_brake() {
  command_brake(0);
  brake_released_s_ = clock_.now_s();
}

double MirrorWorld::brake_torque_Nm() const {
  return has(MirrorFault::brake_slack) ? 0 : brake_Nm_;
}

std::vector<TorqueSample> MirrorWorld::take_samples() {
  advance();
  return std::exchange(samples_, {});
}

}  // namespace rvbench::hal
