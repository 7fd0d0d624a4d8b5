#include "bench/qualification/slow_turning.hpp"

#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::bench {
namespace {

constexpr double getting_there_s = 4;  // 300 rpm at a gentle ramp, and a brake that takes its time
constexpr double looking_s = 3;
constexpr double longest_stop_s = 20;
constexpr double standstill_rpm = 5;

// Of what is told; what is not known once is not counted.
class RunningMean {
 public:
  void take(double value) {
    if (!std::isfinite(value)) return;
    sum_ += value;
    ++count_;
  }
  double value() const { return count_ > 0 ? sum_ / count_ : not_known; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

// The mean speed of the shaft, by the first and the last angle.
class AngleSpan {
 public:
  void take(double time_s, double angle_rad) {
    if (!std::isfinite(first_s_)) {
      first_s_ = time_s;
      first_rad_ = angle_rad;
    }
    last_s_ = time_s;
    last_rad_ = angle_rad;
  }
  // NaN where the angle did not go on.
  double speed_rpm() const {
    return units::rpm_from_rad_s((last_rad_ - first_rad_) / (last_s_ - first_s_));
  }

 private:
  double first_s_ = not_known, first_rad_ = not_known;
  double last_s_ = not_known, last_rad_ = not_known;
};

}  // namespace

double slow_turning_s() { return getting_there_s + looking_s; }

std::optional<Ending> turn_slowly(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                                  double brake_torque_Nm, SlowTurning& seen) {
  loop.command(spec.speed_rpm, brake_torque_Nm);
  if (auto ending = loop.run_for(getting_there_s)) return ending;
  AngleSpan angle;
  RunningMean drive_rpm, brake_Nm, torque_Nm;
  const auto look = [&](const sequences::BenchValues& values) {
    angle.take(values.angle_s, values.angle_rad);
    drive_rpm.take(values.drive.speed_rpm);
    brake_Nm.take(values.brake.torque_Nm);
    torque_Nm.take(values.torque_Nm);
    return false;
  };
  if (auto ending = loop.run_until(look, looking_s).ending) return ending;
  seen = {angle.speed_rpm(), drive_rpm.value(), brake_Nm.value(), torque_Nm.value()};
  return std::nullopt;
}

sequences::Waited come_to_rest(sequences::BenchLoop& loop, double brake_torque_Nm) {
  loop.command(0, brake_torque_Nm);
  const auto stands = [&](const sequences::BenchValues&) {
    return loop.devices().stands_still(standstill_rpm);
  };
  const sequences::Waited waited = loop.run_until(stands, longest_stop_s);
  if (waited.met) loop.command(0, 0);
  return waited;
}

}  // namespace rvbench::bench
