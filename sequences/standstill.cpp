#include "sequences/standstill.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "sequences/interlock_check.hpp"

namespace rvbench::sequences {
namespace {

constexpr double tick_s = 0.01;
constexpr double feed_period_s = 0.1;
constexpr double stop_again_s = 1.0;
constexpr double silence_s = 2.5;    // longer than any watchdog that the sequencer arms with
constexpr double must_last_s = 0.1;  // a shaft that swings back through zero does not stay so long

// What both witnesses say of the speed; NaN where one does not tell.
struct Speeds {
  double angle_rpm = not_known, drive_rpm = not_known;

  bool told() const { return std::isfinite(angle_rpm) || std::isfinite(drive_rpm); }
  // Comparisons with what is not known are false.
  bool slowed_to(const Speeds& now, double share) const {
    return now.angle_rpm < share * angle_rpm || now.drive_rpm < share * drive_rpm;
  }
};

Speeds speeds_of(const BenchDevices& devices) {
  Speeds told;
  told.angle_rpm = std::abs(devices.measured_speed_rpm(0.2));
  if (devices.drive_is_fresh()) told.drive_rpm = std::abs(devices.values().drive.speed_rpm);
  return told;
}

// Tells a drive to stop until it does. One that answers but does not obey would have its watchdog
// fed by every further request: after a stop in vain it hears nothing, so that the watchdog acts.
// So does at once one that had fallen silent when it was told to stop: its answers may be garbled,
// and the requests feed it all the same. It obeys if either witness sees it slow down fast enough
// to stand still within the time-out.
class Stopper {
 public:
  Stopper(BenchDevices& devices, double timeout_s, double now_s)
      : devices_(devices), obeys_share_(1 - stop_again_s / timeout_s) {
    if (devices.drive_fell_silent()) {
      leave_alone(now_s);
    } else {
      next_s_ = now_s + stop_again_s;
    }
  }

  void tick(double now_s) {
    if (!before_.told()) before_ = speeds_of(devices_);
    if (now_s < next_s_) return;
    const Speeds before = std::exchange(before_, speeds_of(devices_));
    if (!was_silent_ && !before.slowed_to(before_, obeys_share_)) return leave_alone(now_s);
    devices_.stop_drive();
    was_silent_ = false;
    next_s_ = now_s + stop_again_s;
  }

 private:
  void leave_alone(double now_s) {
    was_silent_ = true;
    next_s_ = now_s + silence_s;
    devices_.leave_drive_alone(next_s_);
  }

  BenchDevices& devices_;
  double obeys_share_;
  double next_s_ = 0;
  Speeds before_;  // when it was last told to stop
  bool was_silent_ = false;
};

std::optional<Ending> find_trip(const Interlocks& limits, const FreshValues& fresh) {
  if (auto trip = check_interlocks(limits, fresh)) return trip;
  return check_devices(fresh);
}

// How it is known that the shaft stands still, or that it is not known.
std::string how_known(const BenchDevices& devices, bool stopped, double waited_s) {
  const double measured_rpm = std::abs(devices.measured_speed_rpm(0.2));
  if (stopped && std::isfinite(measured_rpm)) {
    return fmt::format("standstill was measured by the shaft's angle {:.1f} s after the stop",
                       waited_s);
  }
  if (stopped) {
    return fmt::format(
        "standstill is what the drive says {:.1f} s after the stop, the angle is lost", waited_s);
  }
  if (std::isfinite(measured_rpm)) {
    return fmt::format("{:.1f} s after the stop the shaft's angle still shows {:.0f} rpm", waited_s,
                       measured_rpm);
  }
  return fmt::format(
      "standstill could not be confirmed within {:.1f} s: neither the angle nor the drive tells a "
      "speed; a drive that has lost its link stops by its own watchdog",
      waited_s);
}

}  // namespace

RunDown wait_for_standstill(BenchLoop& loop, const TestPlan& plan) {
  hal::Rig& rig = loop.rig();
  BenchDevices& devices = loop.devices();
  const double timeout_s = plan.teardown.standstill_timeout_s;
  const double start_s = rig.clock->now_s();
  double moving_s = start_s;
  double told_s = start_s;  // when a speed was told last
  double next_feed_s = start_s;
  RunDown result;
  Stopper stopper(devices, timeout_s, start_s);
  devices.end_speed_commands();
  for (double now_s = start_s; now_s < start_s + timeout_s;) {
    rig.clock->wait_until(now_s + tick_s);
    now_s = rig.clock->now_s();
    devices.read();
    if (const auto trip = find_trip(plan.interlocks, devices.fresh())) {
      result.trouble = graver(result.trouble.value_or(*trip), *trip);
    }
    if (!devices.stands_still(plan.teardown.standstill_rpm)) moving_s = now_s;
    result.stopped = now_s - moving_s >= must_last_s;
    if (result.stopped) break;
    if (speeds_of(devices).told()) told_s = now_s;
    if (!loop.has_turned() && now_s - told_s > plan.interlocks.stale_after_s) break;
    stopper.tick(now_s);
    if (now_s >= next_feed_s) {
      devices.hold_brake(loop.brake_torque_Nm());
      next_feed_s = now_s + feed_period_s;
    }
  }
  if (!result.trouble && !devices.lost().empty()) result.trouble = device_lost(devices.lost());
  if (!result.trouble && !result.stopped) {
    result.trouble = device_lost("the shaft does not stop");
  }
  if (result.trouble && result.trouble->error_kind == ErrorKind::device_lost) {
    const double waited_s = rig.clock->now_s() - start_s;
    result.trouble->reason += "; " + how_known(devices, result.stopped, waited_s);
  }
  return result;
}

}  // namespace rvbench::sequences
